# plumbline_test(NAME SOURCES files... LIBRARIES libs... [NIGHTLY]): one GoogleTest program, each of its tests a CTest test
# named NAME.Suite.Test.
include(GoogleTest)
function(plumbline_test name)
  cmake_parse_arguments(arg "NIGHTLY" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} plumbline::toolchain GTest::gtest_main GTest::gmock)
  # GoogleTest's macros trip these two; the rest of our warnings hold in tests as well.
  target_compile_options(${name} PRIVATE -Wno-shadow -Wno-conversion)
  target_compile_definitions(${name} PRIVATE PLUMBLINE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(arg_NIGHTLY)
    gtest_discover_tests(${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 PROPERTIES LABELS nightly TIMEOUT 10800)
  else()
    gtest_discover_tests(${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
  endif()
endfunction()
