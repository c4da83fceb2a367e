#include "io/channels.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "aureole/io/picture.h"

namespace aureole::io {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return result;
}

std::string layer_of(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? "" : name.substr(0, dot);
}

using Synonyms = std::vector<std::string_view>;

bool is_one_of(const std::string& name, const Synonyms& synonyms) {
    return std::find(synonyms.begin(), synonyms.end(), lower(base_of(name))) != synonyms.end();
}

// The first channel of `layer` with one of these names; -1 if there is none.
int find_channel(const std::vector<std::string>& names, const std::string& layer,
                 const Synonyms& synonyms) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (layer_of(names[i]) == layer && is_one_of(names[i], synonyms)) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

const Synonyms kRed = {"r", "red"};
const Synonyms kGreen = {"g", "green"};
const Synonyms kBlue = {"b", "blue"};
const Synonyms kGrey = {"y", "l", "luminance", "gray", "grey"};
const Synonyms kAlpha = {"a", "alpha"};
const Synonyms kNotColor = {"a", "alpha", "z", "zback", "depth"};

std::optional<ColorChannels> named_color(const std::vector<std::string>& names) {
    std::vector<std::string> layers = {""};
    for (const std::string& name : names) {
        const std::string layer = layer_of(name);
        if (std::find(layers.begin(), layers.end(), layer) == layers.end()) layers.push_back(layer);
    }
    for (const std::string& layer : layers) {
        const int red = find_channel(names, layer, kRed);
        const int green = find_channel(names, layer, kGreen);
        const int blue = find_channel(names, layer, kBlue);
        if (red >= 0 && green >= 0 && blue >= 0) {
            return ColorChannels{{red, green, blue}, find_channel(names, layer, kAlpha)};
        }
    }
    for (const std::string& layer : layers) {
        const int grey = find_channel(names, layer, kGrey);
        if (grey >= 0) return ColorChannels{{grey}, find_channel(names, layer, kAlpha)};
    }
    return std::nullopt;
}

}  // namespace

std::string base_of(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? name : name.substr(dot + 1);
}

bool has_named_color(const std::vector<std::string>& names) {
    return named_color(names).has_value();
}

ColorChannels find_color_channels(const std::vector<std::string>& names) {
    if (const auto named = named_color(names)) return *named;
    const auto other = std::find_if_not(names.begin(), names.end(), [](const std::string& name) {
        return is_one_of(name, kNotColor);
    });
    const std::size_t first =
        other == names.end() ? 0 : static_cast<std::size_t>(other - names.begin());
    const int alpha = find_channel(names, layer_of(names[first]), kAlpha);
    const bool itself = alpha == static_cast<int>(first);
    return {{static_cast<int>(first)}, itself ? -1 : alpha};
}

}  // namespace aureole::io
