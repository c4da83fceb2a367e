// `aureole ibl --preview`: spheres under the filtered environment.
#pragma once

#include <string>
#include <vector>

#include "aureole/ibl/brdf_table.h"
#include "aureole/ibl/preview.h"
#include "session.h"

namespace aureole::app {

// Where the figure of the dominant direction goes: "sheet.png" -> "sheet-dominant-direction.png".
std::string dominant_direction_file(const std::string& preview_file);

// Writes both figures. `irradiance` and `chain` are what was filtered, `exact` the truth.
void write_previews(const std::string& file, const ibl::PreviewChain& exact,
                    const ibl::PreviewChain& chain, const ibl::CubeMap& irradiance,
                    Session& session);

}  // namespace aureole::app
