# Tests against the installed package: the test Package.Install makes the install tree, and
# aureole_package_test() builds a project that finds it.
set(AUREOLE_TEST_PREFIX ${PROJECT_BINARY_DIR}/tests/prefix)

add_test(NAME Package.Install
    COMMAND ${CMAKE_COMMAND} -D build=${PROJECT_BINARY_DIR} -D prefix=${AUREOLE_TEST_PREFIX}
            -D config=$<CONFIG> -P ${CMAKE_CURRENT_LIST_DIR}/InstallForTests.cmake)
set_tests_properties(Package.Install PROPERTIES
    LABELS "consumer;docs" FIXTURES_SETUP installed_package)

# aureole_package_test(NAME SOURCE_DIR [RUN] [OPTIONS option...]): configures and builds the
# project, with the compiler and flags of this build, and with RUN runs its tests.
function(aureole_package_test name source_dir)
    cmake_parse_arguments(arg RUN "" OPTIONS ${ARGN})
    set(command ${CMAKE_CTEST_COMMAND} --build-and-test
        ${source_dir} ${CMAKE_CURRENT_BINARY_DIR}/project
        --build-generator ${CMAKE_GENERATOR} --build-makeprogram ${CMAKE_MAKE_PROGRAM}
        --build-options -DCMAKE_PREFIX_PATH=${AUREOLE_TEST_PREFIX}
            -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
            "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}" ${arg_OPTIONS})
    if(arg_RUN)
        list(APPEND command --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure
                            --no-tests=error)
    endif()
    add_test(NAME ${name} COMMAND ${command})
    set_tests_properties(${name} PROPERTIES FIXTURES_REQUIRED installed_package)
endfunction()
