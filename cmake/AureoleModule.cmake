# aureole_module(NAME [DEPENDS module...] [PRIVATE_LIBS lib...] [TEST_LIBS lib...])
#
# One target per module, aureole::NAME: its public headers are include/aureole/NAME/*.h, its
# implementation src/NAME/*.cpp (none at all makes it header-only), its tests src/NAME/*_test.cpp,
# one executable NAME_test per module. DEPENDS is the one list of what it may include of ours,
# PRIVATE_LIBS what its .cpp files may include of others, TEST_LIBS the same for its tests:
# scripts/check_include_edges.py reads all three from CMakeLists.txt.
#
# CTest labels: unit, or slow for test suites whose name ends in "Slow".
include(GNUInstallDirs)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

# Warnings and language level of our own code; nothing that is installed links it.
add_library(aureole_options INTERFACE)
target_compile_features(aureole_options INTERFACE cxx_std_20)
target_compile_options(aureole_options INTERFACE -Wall -Wextra -Wshadow -Wconversion
                       $<$<BOOL:${AUREOLE_WERROR}>:-Werror>)

set(AUREOLE_MODULES "")

function(aureole_module name)
    cmake_parse_arguments(arg "" "" "DEPENDS;PRIVATE_LIBS;TEST_LIBS" ${ARGN})
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/aureole/${name}/*.h)
    file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
    set(tests ${sources})
    list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
    list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
    list(TRANSFORM arg_DEPENDS PREPEND aureole_)

    set(target aureole_${name})
    if(sources)
        set(scope PUBLIC)
        add_library(${target} ${sources})
        set_target_properties(${target} PROPERTIES
            POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF INSTALL_RPATH $ORIGIN
            VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
        target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
        target_link_libraries(${target} PRIVATE ${arg_PRIVATE_LIBS}
                              $<BUILD_INTERFACE:aureole_options>)
    else()
        set(scope INTERFACE)
        add_library(${target} INTERFACE)
    endif()
    add_library(aureole::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES
        EXPORT_NAME ${name} VERIFY_INTERFACE_HEADER_SETS ON)
    target_sources(${target} ${scope} FILE_SET HEADERS
        BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${headers})
    target_compile_features(${target} ${scope} cxx_std_20)
    target_link_libraries(${target} ${scope} ${arg_DEPENDS})
    install(TARGETS ${target} EXPORT aureoleTargets FILE_SET HEADERS)

    set(AUREOLE_MODULES ${AUREOLE_MODULES} ${target} PARENT_SCOPE)

    if(AUREOLE_BUILD_TESTS AND tests)
        add_executable(${name}_test ${tests})
        target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR}/src
                                   ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/shaders)
        target_link_libraries(${name}_test PRIVATE ${target} ${arg_PRIVATE_LIBS} ${arg_TEST_LIBS}
                              aureole_options GTest::gtest_main GTest::gmock)
        gtest_discover_tests(${name}_test NO_PRETTY_VALUES TEST_FILTER "-*Slow.*"
                             DISCOVERY_TIMEOUT 60 PROPERTIES LABELS unit)
        gtest_discover_tests(${name}_test NO_PRETTY_VALUES TEST_FILTER "*Slow.*" TEST_LIST ${name}_test_slow
                             DISCOVERY_TIMEOUT 60 PROPERTIES LABELS slow)
    endif()
endfunction()
