# Writes the version header: cmake -DROOT=… -DVERSION=… -DOUT=… -P version.cmake
set(commit "unknown")
find_program(git git)
if(git)
  execute_process(COMMAND "${git}" describe --always --dirty --abbrev=12 --exclude=*
                  WORKING_DIRECTORY "${ROOT}" OUTPUT_VARIABLE described RESULT_VARIABLE failed
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    set(commit "${described}")
  endif()
endif()

string(CONCAT text
  "#pragma once\n\n"
  "namespace rockfold {\n"
  "inline constexpr char version[] = \"${VERSION}\";\n"
  "inline constexpr char commit[] = \"${commit}\";  // git, with -dirty where files were changed\n"
  "}  // namespace rockfold\n")
set(old "")
if(EXISTS "${OUT}")
  file(READ "${OUT}" old)
endif()
if(NOT old STREQUAL text)
  file(WRITE "${OUT}" "${text}")
endif()
