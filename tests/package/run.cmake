# Installs the build into an empty prefix, runs the installed program, then configures, builds and
# runs the user's project. Called by ctest with
# -D build=... -D source=... -D work=... -D version=... -D compiler=... -D flags=... -D type=...
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

unset(ENV{DESTDIR})
file(REMOVE_RECURSE "${work}")
run(${CMAKE_COMMAND} --install "${build}" --prefix "${work}/prefix")

execute_process(COMMAND "${work}/prefix/bin/springfold" --version
                OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
string(FIND "${said}" "${version}" place)
if(place EQUAL -1)
  message(FATAL_ERROR "the installed program calls itself \"${said}\", not ${version}")
endif()
if(NOT EXISTS "${work}/prefix/share/springfold/plots/style.gp")
  message(FATAL_ERROR "the plot templates were not installed")
endif()

run(${CMAKE_COMMAND} -S "${source}/tests/package" -B "${work}/user" -G Ninja
    "-DCMAKE_PREFIX_PATH=${work}/prefix" "-DCMAKE_CXX_COMPILER=${compiler}"
    "-DCMAKE_CXX_FLAGS=${flags}" "-DCMAKE_BUILD_TYPE=${type}")
run(${CMAKE_COMMAND} --build "${work}/user")
run("${work}/user/user")
run("${work}/user/user_of_engine")
run("${work}/user/user_of_all" "${source}/cases/orthoglide-planar/case.toml")

# docs/engine.md shows each example's source and what it prints, as they are.
file(READ "${source}/docs/engine.md" document)
foreach(example strut smooth piecewise)
  execute_process(COMMAND "${work}/user/${example}" OUTPUT_VARIABLE said COMMAND_ERROR_IS_FATAL ANY)
  file(READ "${source}/docs/examples/${example}.txt" shown)
  file(READ "${source}/docs/examples/${example}.cpp" code)
  if(NOT said STREQUAL shown)
    message(FATAL_ERROR "docs/examples/${example}.cpp says\n${said}but ${example}.txt shows\n${shown}")
  endif()
  string(FIND "${document}" "```cpp\n${code}```" code_place)
  string(FIND "${document}" "```text\n${shown}```" shown_place)
  if(code_place EQUAL -1 OR shown_place EQUAL -1)
    message(FATAL_ERROR "docs/engine.md does not show docs/examples/${example} as it is")
  endif()
endforeach()
