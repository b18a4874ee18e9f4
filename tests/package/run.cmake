# Installs the build into an empty prefix, then configures, builds and runs the user's project.
# Called by ctest with -D build=... -D source=... -D work=... -D compiler=... -D flags=... -D type=...
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

unset(ENV{DESTDIR})
file(REMOVE_RECURSE "${work}")
run(${CMAKE_COMMAND} --install "${build}" --prefix "${work}/prefix")
run(${CMAKE_COMMAND} -S "${source}" -B "${work}/user" -G Ninja
    "-DCMAKE_PREFIX_PATH=${work}/prefix" "-DCMAKE_CXX_COMPILER=${compiler}"
    "-DCMAKE_CXX_FLAGS=${flags}" "-DCMAKE_BUILD_TYPE=${type}")
run(${CMAKE_COMMAND} --build "${work}/user")
foreach(program IN ITEMS user user_of_all user_of_engine)
  run("${work}/user/${program}")
endforeach()
