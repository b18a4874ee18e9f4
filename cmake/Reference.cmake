# Reference pages of the public headers: cmake --build --preset release --target reference. Fails on any warning.
find_program(SPRINGFOLD_DOXYGEN doxygen)
mark_as_advanced(SPRINGFOLD_DOXYGEN)
if(SPRINGFOLD_DOXYGEN)
  set(reference "${PROJECT_BINARY_DIR}/reference")
  file(CONFIGURE OUTPUT "${reference}/Doxyfile" @ONLY CONTENT [[
PROJECT_NAME = springfold
PROJECT_NUMBER = @PROJECT_VERSION@
INPUT = "@PROJECT_SOURCE_DIR@/include"
STRIP_FROM_PATH = "@PROJECT_SOURCE_DIR@/include"
OUTPUT_DIRECTORY = "@reference@"
RECURSIVE = YES
EXTRACT_ALL = YES
JAVADOC_AUTOBRIEF = YES
MARKDOWN_SUPPORT = YES
GENERATE_LATEX = NO
HAVE_DOT = NO
WARN_IF_INCOMPLETE_DOC = NO
SORT_MEMBER_DOCS = NO
PREDEFINED = DOXYGEN
QUIET = YES
WARNINGS = YES
WARN_IF_UNDOCUMENTED = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
]])
  add_custom_target(reference COMMAND "${SPRINGFOLD_DOXYGEN}" "${reference}/Doxyfile"
    COMMENT "Reference pages: ${reference}/html/index.html" VERBATIM)
endif()
