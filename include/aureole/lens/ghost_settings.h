// What artists change about single ghosts, as text that people edit.
//
// Our format (UTF-8, TOML), one table per ghost:
//     lens = "heliar"              for people; not read
//     [[ghost]]
//     surfaces = [3, 6]            the two that reflect, numbered from 1, in any order
//     enabled = true               absent: true
//     gain = 1.0                   >= 0; absent: 1
//     tint = [1.0, 1.0, 1.0]       linear sRGB, >= 0; absent: white
// Ghosts that are not in the file are as they would be without it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aureole/lens/flare.h"
#include "aureole/lens/ghosts.h"

namespace aureole::lens {

// Every ghost of `all` with its setting among `settings`, or as it would be without. What
// `report` tells of a ghost stands above it as comments, and the ghosts with most energy come
// first; without a report they keep their order. Names of `lens` beyond ASCII must be UTF-8.
std::string ghosts_to_toml(std::string_view lens, std::span<const Bounces> all,
                           std::span<const GhostSetting> settings,
                           const FlareReport* report = nullptr);

// The ghosts of the text, in its order. `file`: its name, for messages. `all`: the ghosts there
// can be. Throws FileError with file, line, entry, value and what is allowed: no TOML; an unknown
// key; a ghost that is not in `all`, or twice in the text; values of another type or out of range.
std::vector<GhostSetting> ghosts_from_toml(std::string_view text, const std::string& file,
                                           std::span<const Bounces> all);

}  // namespace aureole::lens
