# plumbline_add_corpus(NAME name TRACER tracer CASES path... [TRACER_TIMEOUT seconds] [NO_FAULTS]
#                      [LABELS label...])
#
# Registers each .case file as the CTest test name.FILE: it fails as `plumbline replay` does, and its output says by
# how much which answer is wrong. A tracer is a target, of type MODULE or SHARED, that exports plumbline_tracer(); or
# whatever --tracer takes, such as "pipe:python3 my_tracer.py". A path is a .case file, or a folder that is searched
# for them at any depth; relative ones begin at the current source folder, in which the tests run too. New files are
# seen at the next build. With NO_FAULTS a test fails also where the tracer gives no answer, or dies.
function(plumbline_add_corpus)
  cmake_parse_arguments(PARSE_ARGV 0 arg "NO_FAULTS" "NAME;TRACER;TRACER_TIMEOUT" "CASES;LABELS")
  foreach(required NAME TRACER CASES)
    if(NOT arg_${required})
      message(FATAL_ERROR "plumbline_add_corpus: ${required} is missing")
    endif()
  endforeach()
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "plumbline_add_corpus: ${arg_UNPARSED_ARGUMENTS} is too much; there are NAME, TRACER, CASES, "
                        "TRACER_TIMEOUT, NO_FAULTS and LABELS")
  endif()
  set(tracer ${arg_TRACER})
  if(TARGET ${arg_TRACER})
    set(tracer $<TARGET_FILE:${arg_TRACER}>)
  endif()
  set(options)
  if(arg_TRACER_TIMEOUT)
    set(options --tracer-timeout ${arg_TRACER_TIMEOUT})
  endif()
  if(arg_NO_FAULTS)
    list(APPEND options --no-faults)
  endif()

  foreach(path ${arg_CASES})
    cmake_path(ABSOLUTE_PATH path NORMALIZE)
    set(files ${path})
    set(base ${path})
    if(IS_DIRECTORY ${path})
      file(GLOB_RECURSE files CONFIGURE_DEPENDS ${path}/*.case)
      if(NOT files)
        message(FATAL_ERROR "plumbline_add_corpus: ${path} holds no .case file")
      endif()
    elseif(EXISTS ${path})
      cmake_path(GET path PARENT_PATH base)
    else()
      message(FATAL_ERROR "plumbline_add_corpus: ${path} is not there")
    endif()
    foreach(file ${files})
      cmake_path(RELATIVE_PATH file BASE_DIRECTORY ${base} OUTPUT_VARIABLE name)
      cmake_path(REMOVE_EXTENSION name LAST_ONLY)
      cmake_path(RELATIVE_PATH file OUTPUT_VARIABLE shown)
      add_test(NAME ${arg_NAME}.${name}
               COMMAND plumbline::plumbline replay ${shown} --tracer ${tracer} ${options}
               WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
      set_tests_properties(${arg_NAME}.${name} PROPERTIES LABELS "${arg_LABELS}")
    endforeach()
  endforeach()
endfunction()
