# plumbline_embed_text(TARGET HEADER files...): compiles text files into the target. NAME.EXT becomes
# plumbline::NAME_EXT, a std::string_view that HEADER declares.
#
# Included, this defines the function; run as a script (-P), it writes the source of one file: -Dinput, -Doutput,
# -Dheader, -Dsymbol.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ "${input}" text)
  if(text MATCHES "\\)embedded\"")
    message(FATAL_ERROR "${input}: holds )embedded\", which ends the string that it becomes")
  endif()
  file(WRITE "${output}" "#include \"${header}\"\n\n"
                         "const std::string_view plumbline::${symbol} = R\"embedded(${text})embedded\";\n")
  return()
endif()

set(PLUMBLINE_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(plumbline_embed_text target header)
  foreach(file ${ARGN})
    string(REPLACE "." "_" symbol ${file})
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
    add_custom_command(OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -Dinput=${CMAKE_CURRENT_SOURCE_DIR}/${file} -Doutput=${output} -Dheader=${header}
              -Dsymbol=${symbol} -P ${PLUMBLINE_EMBED_SCRIPT}
      DEPENDS ${file} ${PLUMBLINE_EMBED_SCRIPT} VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endforeach()
endfunction()
