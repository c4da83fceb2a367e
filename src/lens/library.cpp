#include "aureole/lens/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/lens/formats.h"

namespace aureole::lens {
namespace {

constexpr std::size_t kNearest = 3;

// Letters to insert, delete or change to get from one to the other (Levenshtein 1966).
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

std::string nearest_ids(std::string_view id) {
    // Long names are not compared: the cost is quadratic, and nothing is near them.
    const std::string_view start = id.substr(0, 64);
    std::vector<std::pair<std::size_t, std::string_view>> ids;
    for (const ShippedLens& lens : shipped_lenses()) {
        const bool part = !start.empty() && lens.id.find(start) != std::string_view::npos;
        ids.emplace_back(part ? 0 : edit_distance(start, lens.id), lens.id);
    }
    std::sort(ids.begin(), ids.end());
    std::string list;
    for (std::size_t i = 0; i < std::min(kNearest, ids.size()); ++i) {
        list += (i > 0 ? ", " : "") + std::string(ids[i].second);
    }
    return list;
}

}  // namespace

Prescription shipped_lens(std::string_view id) {
    const auto lenses = shipped_lenses();
    const auto lens = std::find_if(lenses.begin(), lenses.end(),
                                   [&](const ShippedLens& shipped) { return shipped.id == id; });
    if (lens == lenses.end()) {
        throw InvalidArgument(
            "lens", std::string(id),
            fmt::format("must be one of the {} lenses that come with Aureole; near this name: {}",
                        lenses.size(), nearest_ids(id)));
    }
    return parse_toml(lens->toml, std::string(id) + ".toml");
}

}  // namespace aureole::lens
