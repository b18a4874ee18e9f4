# The HTML page of `run --report`: its files and D3 (Debian: libjs-d3) become part of the program, so that the page needs
# nothing else. Nothing of D3 lies in this repository.
option(SPRINGFOLD_REPORT "Build in the HTML page of run --report; needs D3 3.5 (Debian: libjs-d3)" ON)

# A text as a C++ literal. No line of ours or of D3 has the delimiter.
function(springfold_literal variable file)
  file(READ "${file}" text)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  set(${variable} "R\"springfold(${text})springfold\"" PARENT_SCOPE)
endfunction()

set(springfold_report_source "${CMAKE_CURRENT_BINARY_DIR}/generated/report_assets.cpp")
set(report_head "#include \"report_assets.hpp\"\n\nnamespace springfold::io {\n\n")
set(report_tail "\n}  // namespace springfold::io\n")
if(SPRINGFOLD_REPORT)
  find_file(SPRINGFOLD_D3 d3.min.js PATHS /usr/share/javascript/d3 NO_DEFAULT_PATH)
  find_file(SPRINGFOLD_D3_LICENCE copyright PATHS /usr/share/doc/libjs-d3 NO_DEFAULT_PATH)
  mark_as_advanced(SPRINGFOLD_D3 SPRINGFOLD_D3_LICENCE)
  if(NOT SPRINGFOLD_D3 OR NOT SPRINGFOLD_D3_LICENCE)
    message(FATAL_ERROR "D3 is needed for the HTML page of `run --report`: install libjs-d3 (scripts/setup.sh does), "
      "set SPRINGFOLD_D3 and SPRINGFOLD_D3_LICENCE, or leave the page out with -DSPRINGFOLD_REPORT=OFF")
  endif()
  set(report "${PROJECT_SOURCE_DIR}/report")
  springfold_literal(frame "${report}/page.html")
  springfold_literal(style "${report}/page.css")
  springfold_literal(data "${report}/data.js")
  springfold_literal(mechanism "${report}/mechanism.js")
  springfold_literal(names "${report}/names.js")
  springfold_literal(map "${report}/map.js")
  springfold_literal(smooth "${report}/smooth.js")
  springfold_literal(overlaps "${report}/overlaps.js")
  springfold_literal(diagram "${report}/diagram.js")
  springfold_literal(page "${report}/page.js")
  springfold_literal(d3 "${SPRINGFOLD_D3}")
  springfold_literal(licence "${SPRINGFOLD_D3_LICENCE}")
  file(CONFIGURE OUTPUT "${springfold_report_source}" @ONLY CONTENT
    "@report_head@ReportAssets report_assets() {\n  return {@frame@,\n@style@,\n@data@\n@names@\n@mechanism@\n@map@\n@smooth@\n@overlaps@\n@diagram@\n@page@,\n@d3@,\n@licence@};\n}\n@report_tail@")
else()
  file(CONFIGURE OUTPUT "${springfold_report_source}" @ONLY CONTENT
    "@report_head@ReportAssets report_assets() { return {}; }\n@report_tail@")
endif()
# The page is longer than compilers need accept; Clang says so.
set_source_files_properties("${springfold_report_source}" PROPERTIES
  SKIP_UNITY_BUILD_INCLUSION ON COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:Clang>:-Wno-overlength-strings>")
