# Writes the example models as C++: cmake -DCASES=tests/cases -DOUT=examples_data.cpp -P embed_examples.cmake
# An example is a folder with a model.toml whose first line is a comment that says what it shows. The
# files that the model names (lines `file = "NAME"`) lie beside it, are text and belong to the example.
set(largest_file 200000)   # bytes
set(literal 8000)          # bytes; compilers limit the length of one literal, not of several in a row

file(GLOB models "${CASES}/*/model.toml")
list(SORT models)

# A text as raw string literals, which the compiler joins.
function(embed text result)
  string(LENGTH "${text}" length)
  set(literals "")
  foreach(start RANGE 0 ${length} ${literal})
    string(SUBSTRING "${text}" ${start} ${literal} part)
    string(APPEND literals "     R\"text(${part})text\"\n")
  endforeach()
  set(${result} "${literals}" PARENT_SCOPE)
endfunction()

set(files "")
set(entries "")
foreach(model IN LISTS models)
  get_filename_component(folder "${model}" DIRECTORY)
  get_filename_component(name "${folder}" NAME)
  file(READ "${model}" text)
  if(NOT text MATCHES "^# ([^\n]+)\n")
    message(FATAL_ERROR "${model}: the first line must be a comment that says what the example shows")
  endif()
  set(summary "${CMAKE_MATCH_1}")
  embed("${text}" model_literals)

  string(REGEX MATCHALL "\n *file *= *\"[^\"\n]+\"" named "${text}")
  set(entry_files "")
  list(LENGTH named count)
  foreach(line IN LISTS named)
    string(REGEX REPLACE ".*\"(.+)\"" "\\1" file "${line}")
    if(file MATCHES "[/\\]" OR NOT EXISTS "${folder}/${file}")
      message(FATAL_ERROR "${model}: names ${file}, which must lie in the same folder")
    endif()
    file(SIZE "${folder}/${file}" size)
    if(size GREATER largest_file)
      message(FATAL_ERROR "${folder}/${file}: ${size} bytes; an example's file has at most ${largest_file}")
    endif()
    file(READ "${folder}/${file}" text)
    embed("${text}" file_literals)
    string(APPEND entry_files "    {\"${file}\",\n${file_literals}    },\n")
  endforeach()

  set(list "{}")
  if(count GREATER 0)
    string(APPEND files "constexpr auto files_of_${name} = std::to_array<ExampleFile>({\n${entry_files}});\n\n")
    set(list "files_of_${name}")
  endif()
  string(APPEND entries
    "    {\"${name}\", R\"line(${summary})line\",\n${model_literals}     ,\n     ${list}},\n")
endforeach()

file(WRITE "${OUT}"
  "#include <array>\n\n#include \"src/app/examples.hpp\"\n\nnamespace rockfold {\n\n"
  "namespace {\n\n${files}}  // namespace\n\n"
  "std::span<const Example> examples() {\n"
  "  static constexpr auto all = std::to_array<Example>({\n${entries}  });\n"
  "  return all;\n}\n\n}  // namespace rockfold\n")
