# Examples of the documents, compiled word for word and run.
enable_testing()

# readme_examples(DOCUMENT LANGUAGE TARGET sources ...) -- a program for each block of the language in a document, in their order, linked
# to the target. A source is made of SOURCE.in, where @EXAMPLE@ stands for the block. There must be as many sources as blocks.
# Programs get a cube, an OBJ, as their argument.
function(readme_examples document language target)
  file(READ ${SUBLIMIT_SOURCE}/${document} rest)
  foreach(source IN LISTS ARGN)
    string(REGEX MATCH "```${language}\n([^`]*)```" fence "${rest}")
    set(EXAMPLE "${CMAKE_MATCH_1}")
    if(NOT EXAMPLE)
      message(FATAL_ERROR "${document} has no example in ${language} for ${source}")
    endif()
    string(FIND "${rest}" "${fence}" begin)
    string(LENGTH "${fence}" length)
    math(EXPR end "${begin} + ${length}")
    string(SUBSTRING "${rest}" ${end} -1 rest)
    configure_file(${source}.in ${source} @ONLY)
    cmake_path(GET source STEM program)
    add_executable(${program} ${CMAKE_CURRENT_BINARY_DIR}/${source})
    target_link_libraries(${program} PRIVATE ${target})
    add_test(NAME ${program} COMMAND ${program} ${CMAKE_CURRENT_BINARY_DIR}/cube.obj)
  endforeach()
  if(rest MATCHES "```${language}\n")
    message(FATAL_ERROR "${document} has more examples in ${language} than ${ARGN}: name a source for each")
  endif()
endfunction()

file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/cube.obj "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
     "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
