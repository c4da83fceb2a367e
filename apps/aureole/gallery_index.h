// The page that shows the gallery.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace aureole::app {

struct IndexPanel {
    std::string label;
    nlohmann::ordered_json parameters;
    nlohmann::ordered_json energy;
};

struct IndexCase {
    std::string name;
    std::string title;
    std::string text;
    std::string sheet;  // file name
    std::vector<IndexPanel> panels;
    std::string frames_text;  // what the sequence shows; empty without one
    std::vector<IndexPanel> frame_rows;
    std::string first_frame;  // file name
    std::string video;        // file name; empty without one
};

// HTML that needs nothing but the files beside it: no script, no font, no server. Light or dark as
// the reader's system is.
std::string gallery_index(const std::vector<IndexCase>& cases);

}  // namespace aureole::app
