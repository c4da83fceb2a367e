// The lenses that come with Aureole: data/lenses/*.toml, built into the library.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "aureole/lens/prescription.h"

namespace aureole::lens {

struct ShippedLens {
    std::string_view id;    // "heliar": what --lens takes; the file's name without extension
    std::string_view toml;  // the file
};

// In alphabetical order.
std::span<const ShippedLens> shipped_lenses();

// Throws InvalidArgument for an unknown id, with those that are near it.
Prescription shipped_lens(std::string_view id);

}  // namespace aureole::lens
