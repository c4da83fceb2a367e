#include "gallery_index.h"

#include <fmt/format.h>

#include <algorithm>

namespace aureole::app {
namespace {

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Aureole: test cases of glare</title>
<style>
:root { color-scheme: light dark; }
body { max-width: 76rem; margin: 2rem auto; padding: 0 1rem; font: 1rem/1.5 system-ui, sans-serif;
  background: #e8e8e8; color: #1c1c1c; }
h1, h2 { line-height: 1.2; font-weight: 600; }
h2 { margin-top: 3rem; }
a { color: inherit; }
nav a { margin-right: 1rem; }
img, video { max-width: 100%; height: auto; display: block; margin: 1rem 0; }
summary { cursor: pointer; margin: .5rem 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .85rem; }
th, td { padding: .2rem .7rem; border-bottom: 1px solid #8886; text-align: left;
  vertical-align: top; font-variant-numeric: tabular-nums; }
@media (prefers-color-scheme: dark) { body { background: #1c1c1c; color: #dcdcdc; } }
</style>
</head>
<body>
<h1>Test cases of glare</h1>
<p>Procedural scenes in absolute luminance, seen by a simulated eye: out = in * PSF, without a
threshold, energy conserved. Luminances in cd/m<sup>2</sup>, angles in degrees, energies in
cd/m<sup>2</sup> sr summed over the three colours.</p>
<p>Of these, in + from_surround = out + off_picture + blocked: the light of the scene and what comes
in from beyond the border is seen, leaves the picture or ends at the lids. Of in, glare takes spread
from the pixels that it comes from, to other ones or off the picture.</p>
)";

std::string escaped(const std::string& text) {
    std::string html;
    for (const char c : text) {
        html += c == '&'   ? "&amp;"
                : c == '<' ? "&lt;"
                : c == '>' ? "&gt;"
                : c == '"' ? "&quot;"
                           : std::string(1, c);
    }
    return html;
}

std::string words_for(const nlohmann::ordered_json& value) {
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    std::string text;
    if (value.is_array()) {
        for (const auto& item : value) {
            text += (text.empty() ? "" : item.is_object() ? "; " : " ") + words_for(item);
        }
        return text;
    }
    if (value.is_object()) {
        for (const auto& [key, item] : value.items()) {
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", key, words_for(item));
        }
        return text;
    }
    return value.dump();
}

// Keys of all panels, in the order in which they first appear.
std::vector<std::string> keys_of(const std::vector<IndexPanel>& panels) {
    std::vector<std::string> keys;
    for (const IndexPanel& panel : panels) {
        for (const auto& item : panel.parameters.items()) {
            if (std::find(keys.begin(), keys.end(), item.key()) == keys.end()) {
                keys.push_back(item.key());
            }
        }
    }
    return keys;
}

std::string value_of(const IndexPanel& panel, const std::string& key) {
    return panel.parameters.contains(key) ? words_for(panel.parameters[key]) : "";
}

// What all panels share in a sentence, what differs in a table.
std::string parameters_html(const std::string& what, const std::vector<IndexPanel>& panels) {
    std::string shared;
    std::vector<std::string> columns;
    for (const std::string& key : keys_of(panels)) {
        const std::string first = value_of(panels.front(), key);
        const bool same = std::all_of(panels.begin(), panels.end(), [&](const IndexPanel& panel) {
            return value_of(panel, key) == first;
        });
        if (same) {
            shared += fmt::format("{}{} {}", shared.empty() ? "" : ", ", key, first);
        } else {
            columns.push_back(key);
        }
    }
    std::string html = "<details>\n<summary>Parameters of every " + what + "</summary>\n";
    if (!shared.empty()) html += "<p>Of all: " + escaped(shared) + ".</p>\n";
    html += "<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">" + what + "</th>";
    for (const std::string& key : columns) {
        html += "<th scope=\"col\">" + escaped(key) + "</th>";
    }
    for (const auto& item : panels.front().energy.items()) {
        html += "<th scope=\"col\">" + escaped("energy " + item.key()) + "</th>";
    }
    html += "</tr></thead>\n<tbody>\n";
    for (const IndexPanel& panel : panels) {
        html += "<tr><th scope=\"row\">" + escaped(panel.label) + "</th>";
        for (const std::string& key : columns) {
            html += "<td>" + escaped(value_of(panel, key)) + "</td>";
        }
        for (const auto& item : panel.energy.items()) {
            html += "<td>" + escaped(words_for(item.value())) + "</td>";
        }
        html += "</tr>\n";
    }
    return html + "</tbody>\n</table></div>\n</details>\n";
}

std::string sequence_html(const IndexCase& one) {
    if (one.frame_rows.empty()) return "";
    std::string html =
        "<p>" + escaped(one.frames_text) +
        fmt::format(" {} frames, from <a href=\"{}\">{}</a> on.</p>\n", one.frame_rows.size(),
                    escaped(one.first_frame), escaped(one.first_frame));
    if (!one.video.empty()) {
        html += fmt::format(
            "<video src=\"{}\" controls loop muted playsinline preload=\"metadata\"></video>\n",
            escaped(one.video));
    }
    return html + parameters_html("frame", one.frame_rows);
}

}  // namespace

std::string gallery_index(const std::vector<IndexCase>& cases) {
    std::string html = kHead;
    html += "<nav>\n";
    for (const IndexCase& one : cases) {
        html += fmt::format("<a href=\"#{}\">{}</a>\n", escaped(one.name), escaped(one.title));
    }
    html += "</nav>\n";
    for (const IndexCase& one : cases) {
        html += fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n<p>{}</p>\n", escaped(one.name),
                            escaped(one.title), escaped(one.text));
        html += fmt::format("<a href=\"{0}\"><img src=\"{0}\" alt=\"{1}: contact sheet\"></a>\n",
                            escaped(one.sheet), escaped(one.title));
        html += parameters_html("panel", one.panels) + sequence_html(one) + "</section>\n";
    }
    return html + "</body>\n</html>\n";
}

}  // namespace aureole::app
