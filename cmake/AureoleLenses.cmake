# The lens tables data/lenses/*.toml, built into aureole::lens as shipped_lenses() of
# aureole/lens/library.h, and installed beside it as files to start from.
file(GLOB tables CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/data/lenses/*.toml)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${tables})

set(AUREOLE_LENS_TABLES "")
foreach(table IN LISTS tables)
    get_filename_component(id ${table} NAME_WE)
    file(READ ${table} text)
    string(LENGTH "${text}" length)
    if(length GREATER 16000)
        # Compilers need not take string literals of more than 65536 characters, some stop at 16380.
        message(FATAL_ERROR "${table}: ${length} characters, at most 16000 can be built in")
    endif()
    string(APPEND AUREOLE_LENS_TABLES "    {\"${id}\", R\"~(${text})~\"},\n")
endforeach()

file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/shipped_lenses.cpp @ONLY CONTENT
[[// Made by cmake/AureoleLenses.cmake from data/lenses.
#include "aureole/lens/library.h"

namespace aureole::lens {

std::span<const ShippedLens> shipped_lenses() {
    static constexpr ShippedLens kLenses[] = {
@AUREOLE_LENS_TABLES@    };
    return kLenses;
}

}  // namespace aureole::lens
]])
target_sources(aureole_lens PRIVATE ${PROJECT_BINARY_DIR}/generated/shipped_lenses.cpp)
install(FILES ${tables} DESTINATION ${CMAKE_INSTALL_DATADIR}/aureole/lenses)
