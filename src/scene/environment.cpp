#include "aureole/scene/environment.h"

#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "scene/environments.h"

namespace aureole::scene {
namespace {

struct Entry {
    EnvironmentInfo info;
    Environment (*make)(const EnvironmentOptions&);
};

constexpr Entry kEnvironments[] = {
    {{"studio", "environment: soft boxes and rim lights of 2500 to 14000 cd/m2, dark room"},
     make_studio},
    {{"interior", "environment: a room with a window, luminaires, wood, books, pictures"},
     make_interior},
    {{"overcast", "environment: CIE overcast sky, 7000 cd/m2 in the zenith, over a field"},
     make_overcast},
    {{"sunny", "environment: CIE clear sky with the sun, 1.6e9 cd/m2 and 0.53 deg"},
     make_clear_sky},
};

void check_size(const char* what, int value) {
    if (value < 1 || value > 32768) {
        throw InvalidArgument(what, std::to_string(value), "must be 1 to 32768 pixels");
    }
}

}  // namespace

std::span<const EnvironmentInfo> list_environments() {
    static const auto infos = [] {
        std::vector<EnvironmentInfo> list;
        for (const Entry& entry : kEnvironments) list.push_back(entry.info);
        return list;
    }();
    return infos;
}

Environment make_environment(std::string_view name, const EnvironmentOptions& options) {
    std::string names;
    for (const Entry& entry : kEnvironments) {
        names += (names.empty() ? "" : ", ") + std::string(entry.info.name);
        if (entry.info.name != name) continue;
        check_size("width", options.width);
        check_size("height", options.height);
        return entry.make(options);
    }
    throw InvalidArgument("environment", std::string(name), "must be one of " + names);
}

}  // namespace aureole::scene
