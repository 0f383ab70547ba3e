# What every target of Rockfold is built with, for the whole program and for kernels/ alone.
include_guard(GLOBAL)

get_filename_component(ROCKFOLD_ROOT "${CMAKE_CURRENT_LIST_DIR}/.." ABSOLUTE)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug or RelWithDebInfo" FORCE)
endif()
# -O3 keeps the assertions of CGAL and of the standard library off, as Release always does.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG" CACHE STRING "Flags of a release build")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)  # what one folder finds, the folders that link it can see

option(ROCKFOLD_WERROR "Treat warnings as errors" OFF)
option(ROCKFOLD_NATIVE "Use this machine's instruction set (answers may differ between machines)" OFF)
option(ROCKFOLD_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
option(ROCKFOLD_CCACHE "Compile through ccache where it is installed" ON)

# Kokkos' launcher, which picks nvcc for the files that need it, does not understand a second launcher before it.
if(ROCKFOLD_CCACHE AND NOT Kokkos_ENABLE_CUDA AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(ROCKFOLD_CCACHE_PROGRAM ccache)
  mark_as_advanced(ROCKFOLD_CCACHE_PROGRAM)
  if(ROCKFOLD_CCACHE_PROGRAM)
    # Paths below the root count relative to it: what one checkout compiled serves every other.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${ROCKFOLD_ROOT}" CCACHE_NOHASHDIR=1
        "${ROCKFOLD_CCACHE_PROGRAM}")
  endif()
endif()

# For everything in the build, also GoogleTest and Kokkos where these are built from source.
# A contracted multiply-add rounds once where two operations round twice: off, so that a compiler or a processor
# that could contract gives the same digits as one that cannot.
add_compile_options(-ffp-contract=off)
if(ROCKFOLD_NATIVE)
  add_compile_options(-march=native)
endif()
if(ROCKFOLD_SANITIZE)
  # Addresses are the address sanitizer's part; the undefined-behaviour sanitizer's checks of them are most of what it costs to compile.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

if(ROCKFOLD_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "ROCKFOLD_FUZZ needs clang (libFuzzer): -DCMAKE_CXX_COMPILER=clang++")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
endif()

# Warnings of our own targets. nvcc's generated host code trips -Wpedantic on every line.
function(rockfold_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow)
  if(NOT Kokkos_ENABLE_CUDA)
    target_compile_options(${target} PRIVATE -Wpedantic)
  endif()
  # GCC 12 sees overlaps in std::string where there are none (its bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  # Under the sanitizers GCC cannot follow what is initialized (its manual, -fsanitize); it sees faults in CGAL's headers.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND ROCKFOLD_SANITIZE)
    target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
  endif()
  if(ROCKFOLD_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()

# rockfold_library(NAME FOLDERS folder… [PUBLIC target…] [PRIVATE target…])
# A static library of all .cpp files in the folders (and below), known as rockfold::NAME. Without a .cpp it is headers alone.
# Private targets stay private: neither their headers nor their flags reach those who link the library.
function(rockfold_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;PUBLIC;PRIVATE")
  set(sources)
  foreach(folder IN LISTS arg_FOLDERS)
    file(GLOB_RECURSE found CONFIGURE_DEPENDS "${ROCKFOLD_ROOT}/${folder}/*.cpp" "${ROCKFOLD_ROOT}/${folder}/*.hpp")
    list(APPEND sources ${found})
  endforeach()
  set(code ${sources})
  list(FILTER code INCLUDE REGEX "\\.cpp$")

  set(target rockfold_${name})
  if(code)
    add_library(${target} STATIC ${sources})
    target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
    rockfold_warnings(${target})
    set(scope PUBLIC)
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE ${arg_PUBLIC})
    set(scope INTERFACE)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} "$<BUILD_INTERFACE:${ROCKFOLD_ROOT}>"
                             "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rockfold>")
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  add_library(rockfold::${name} ALIAS ${target})

  if(ROCKFOLD_INSTALL)
    install(TARGETS ${target} EXPORT rockfold-${name} ARCHIVE COMPONENT libraries)
    install(EXPORT rockfold-${name} NAMESPACE rockfold:: DESTINATION "${ROCKFOLD_CMAKE_DIR}" COMPONENT libraries)
    foreach(folder IN LISTS arg_FOLDERS)
      install(DIRECTORY "${ROCKFOLD_ROOT}/${folder}/" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/rockfold/${folder}"
              COMPONENT libraries FILES_MATCHING PATTERN "*.hpp" PATTERN "*_exact.hpp" EXCLUDE PATTERN "*_kernel.hpp" EXCLUDE)
    endforeach()
  endif()
endfunction()
