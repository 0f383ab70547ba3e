# Builds the page of `rockfold view` and the script of a report's views (src/web/README.md) in the build tree and sets ROCKFOLD_PAGE_SOURCE to the C++ file that holds it.
# What it needs comes from npm, once: the lockfile names versions and checksums. Where npm is missing or cannot fetch, the program is
# built without the page, and `view` says so. Decided when CMake runs, within ROCKFOLD_NPM_SECONDS.
option(ROCKFOLD_PAGE "Build the page of rockfold view (needs npm)" ON)
set(ROCKFOLD_NPM_SECONDS 120 CACHE STRING "Longest time that fetching the page's packages may take")

set(web "${CMAKE_CURRENT_LIST_DIR}")
set(ROCKFOLD_WEB_TREE "${CMAKE_BINARY_DIR}/web")
set(ROCKFOLD_PAGE_SOURCE "${CMAKE_CURRENT_BINARY_DIR}/page_data.cpp")
set(ROCKFOLD_HAS_PAGE FALSE)

# rockfold_npm(PACKAGES…): `npm ci` with these options in the web tree, unless that was done for this lockfile.
function(rockfold_npm stamp)
  file(SHA256 "${web}/package-lock.json" wanted)
  set(stamp_file "${ROCKFOLD_WEB_TREE}/${stamp}.stamp")
  set(present "")
  if(EXISTS "${stamp_file}")
    file(READ "${stamp_file}" present)
  endif()
  if(present STREQUAL wanted)
    return()
  endif()
  file(COPY "${web}/package.json" "${web}/package-lock.json" DESTINATION "${ROCKFOLD_WEB_TREE}")
  # Ten seconds for the registry to answer, no second try: without a network this is over soon.
  execute_process(
    COMMAND "${ROCKFOLD_NPM}" ci --no-audit --no-fund --ignore-scripts --fetch-timeout=10000 --fetch-retries=0 ${ARGN}
    WORKING_DIRECTORY "${ROCKFOLD_WEB_TREE}" TIMEOUT ${ROCKFOLD_NPM_SECONDS} RESULT_VARIABLE failed
    OUTPUT_FILE "${ROCKFOLD_WEB_TREE}/npm.log" ERROR_FILE "${ROCKFOLD_WEB_TREE}/npm.log")
  if(NOT failed EQUAL 0)
    set(ROCKFOLD_NPM_FAILED "${failed}" PARENT_SCOPE)
    return()
  endif()
  file(WRITE "${stamp_file}" "${wanted}")
endfunction()

if(ROCKFOLD_PAGE)
  find_program(ROCKFOLD_NPM npm)
  find_program(ROCKFOLD_NODE NAMES node nodejs)
  if(ROCKFOLD_NPM AND ROCKFOLD_NODE)
    rockfold_npm(npm --omit=dev)
    if(DEFINED ROCKFOLD_NPM_FAILED)
      message(STATUS "The page: npm could not fetch its packages (${ROCKFOLD_WEB_TREE}/npm.log); built without `view`")
    else()
      set(ROCKFOLD_HAS_PAGE TRUE)
    endif()
  else()
    message(STATUS "The page: npm was not found; built without `view`")
  endif()
endif()

set(page_arguments "")
set(page_files "")
if(ROCKFOLD_HAS_PAGE)
  file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS "${web}/*.ts" "${web}/*.css" "${web}/*.html" "${web}/*.mjs" "${web}/*.json")
  list(FILTER page_sources EXCLUDE REGEX "/(node_modules|test)/")
  foreach(name IN ITEMS page.html views.js)
    list(APPEND page_files "${ROCKFOLD_WEB_TREE}/${name}.gz" "${ROCKFOLD_WEB_TREE}/${name}.size")
  endforeach()
  add_custom_command(OUTPUT ${page_files}
    COMMAND "${CMAKE_COMMAND}" -E env "NODE_PATH=${ROCKFOLD_WEB_TREE}/node_modules"
            "${ROCKFOLD_NODE}" "${web}/build.mjs" "${ROCKFOLD_WEB_TREE}"
    DEPENDS ${page_sources} VERBATIM)
  set(page_arguments "-DFOLDER=${ROCKFOLD_WEB_TREE}")
endif()
set(embed "${ROCKFOLD_ROOT}/src/page/embed_page.cmake")
add_custom_command(OUTPUT "${ROCKFOLD_PAGE_SOURCE}"
  COMMAND "${CMAKE_COMMAND}" ${page_arguments} "-DOUT=${ROCKFOLD_PAGE_SOURCE}" -P "${embed}"
  DEPENDS ${page_files} "${embed}" VERBATIM)
