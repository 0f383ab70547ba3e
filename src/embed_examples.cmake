# Writes the example models as C++: cmake -DCASES=tests/cases -DOUT=examples_data.cpp -P embed_examples.cmake
# An example is a folder with a model.toml whose first line is a comment that says what it shows.
file(GLOB models "${CASES}/*/model.toml")
list(SORT models)

set(entries "")
foreach(model IN LISTS models)
  get_filename_component(folder "${model}" DIRECTORY)
  get_filename_component(name "${folder}" NAME)
  file(READ "${model}" text)
  if(NOT text MATCHES "^# ([^\n]+)\n")
    message(FATAL_ERROR "${model}: the first line must be a comment that says what the example shows")
  endif()
  string(APPEND entries "    {\"${name}\", R\"line(${CMAKE_MATCH_1})line\",\n     R\"model(${text})model\"},\n")
endforeach()

file(WRITE "${OUT}"
  "#include <array>\n\n#include \"src/examples.hpp\"\n\nnamespace rockfold {\n\n"
  "std::span<const Example> examples() {\n"
  "  static constexpr auto all = std::to_array<Example>({\n${entries}  });\n"
  "  return all;\n}\n\n}  // namespace rockfold\n")
