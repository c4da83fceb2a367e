// Contact sheets: panels in rows, each with its name and parameters beneath it.
#pragma once

#include <string>
#include <vector>

#include "aureole/image/drawing.h"

namespace aureole::app {

struct SheetPanel {
    std::string label;
    std::string detail;  // smaller, below the label
    Image display;       // sRGB values; all of one size
};

// At contact_sheet_width_px() a PNG shows the panels pixel by pixel; letters grow with them.
Drawing contact_sheet(const std::string& title, const std::vector<SheetPanel>& panels, int columns);
int contact_sheet_width_px(const std::vector<SheetPanel>& panels, int columns);

}  // namespace aureole::app
