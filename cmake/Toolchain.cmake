# Warnings and instrumentation shared by every target of ours.
add_library(plumbline_toolchain INTERFACE)
add_library(plumbline::toolchain ALIAS plumbline_toolchain)
target_compile_options(plumbline_toolchain INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
target_include_directories(plumbline_toolchain INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(plumbline_toolchain INTERFACE plumbline::strict_fp)

if(PLUMBLINE_SANITIZE)
  target_compile_options(plumbline_toolchain INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(plumbline_toolchain INTERFACE -fsanitize=address,undefined)
endif()

if(PLUMBLINE_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "PLUMBLINE_FUZZ needs clang: libFuzzer is part of it. Use the preset 'fuzz'.")
  endif()
  target_compile_options(plumbline_toolchain INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(plumbline_toolchain INTERFACE -fsanitize=fuzzer-no-link)
endif()

# plumbline_library(NAME sources...): a static library plumbline::NAME of the folder it is called from.
function(plumbline_library name)
  add_library(plumbline_${name} STATIC ${ARGN})
  add_library(plumbline::${name} ALIAS plumbline_${name})
  target_link_libraries(plumbline_${name} PUBLIC $<BUILD_INTERFACE:plumbline::toolchain>)
endfunction()
