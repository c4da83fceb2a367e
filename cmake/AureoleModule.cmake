# aureole_module(NAME [DEPENDS module...] [PRIVATE_LIBS lib...] [TEST_LIBS lib...])
#
# One target per module, aureole::NAME, from src/NAME/*.cpp; its public headers are
# include/aureole/NAME/*.h; its tests are src/NAME/*_test.cpp, one executable per module.
set_property(GLOBAL PROPERTY USE_FOLDERS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

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

    set(target aureole_${name})
    add_library(${target} ${sources})
    add_library(aureole::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES
        EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF
        VERIFY_INTERFACE_HEADER_SETS ON)
    target_sources(${target} PUBLIC FILE_SET HEADERS
        BASE_DIRS ${PROJECT_SOURCE_DIR}/include FILES ${headers})
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
    list(TRANSFORM arg_DEPENDS PREPEND aureole_)
    target_link_libraries(${target} PUBLIC ${arg_DEPENDS}
                          PRIVATE ${arg_PRIVATE_LIBS} $<BUILD_INTERFACE:aureole_options>)
    install(TARGETS ${target} EXPORT aureoleTargets FILE_SET HEADERS)

    set(AUREOLE_MODULES ${AUREOLE_MODULES} ${target} PARENT_SCOPE)

    if(AUREOLE_BUILD_TESTS AND tests)
        add_executable(${name}_test ${tests})
        target_include_directories(${name}_test PRIVATE ${PROJECT_SOURCE_DIR}/src
                                   ${PROJECT_SOURCE_DIR}/tests)
        target_link_libraries(${name}_test PRIVATE ${target} ${arg_PRIVATE_LIBS} ${arg_TEST_LIBS}
                              aureole_options GTest::gtest_main GTest::gmock)
        gtest_discover_tests(${name}_test PROPERTIES LABELS unit DISCOVERY_TIMEOUT 60)
    endif()
endfunction()
