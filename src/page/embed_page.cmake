# Writes what src/web built as C++: cmake -DFOLDER=… -DOUT=page_data.cpp -P embed_page.cmake. In the folder each NAME.gz has the
# bytes of its text in NAME.size. Without FOLDER: a program without a page.
file(WRITE "${OUT}" "#include \"src/page/page_bundle.hpp\"\n\nnamespace rockfold {\n\n")
foreach(bundle IN ITEMS page:page.html views:views.js)
  string(REPLACE ":" ";" bundle "${bundle}")
  list(GET bundle 0 function)
  list(GET bundle 1 name)
  set(bytes "0")
  set(size 0)
  set(count 0)
  if(FOLDER)
    file(READ "${FOLDER}/${name}.gz" hex HEX)
    file(READ "${FOLDER}/${name}.size" size)
    string(STRIP "${size}" size)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
    file(SIZE "${FOLDER}/${name}.gz" count)
  endif()
  file(APPEND "${OUT}"
    "PageBundle ${function}_bundle() {\n"
    "  static constexpr std::uint8_t gzip[] = {${bytes}};\n"
    "  return {{gzip, ${count}}, ${size}};\n}\n\n")
endforeach()
file(APPEND "${OUT}" "}  // namespace rockfold\n")
