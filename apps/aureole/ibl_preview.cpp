#include "ibl_preview.h"

#include <cmath>
#include <filesystem>

#include "aureole/ibl/brdf_table.h"
#include "aureole/io/write_drawing.h"
#include "display_options.h"

namespace aureole::app {
namespace {

void write_sheet(const std::string& file, const ibl::PreviewSheet& sheet) {
    const DisplayOptions display;  // as PNGs look by default
    const Image encoded = display.encode(sheet.pixels, std::log2(sheet.exposure_scale));
    io::write_drawing(file, ibl::preview_drawing(sheet, encoded),
                      ibl::preview_drawing_width_px(sheet));
}

}  // namespace

std::string dominant_direction_file(const std::string& preview_file) {
    const std::filesystem::path path(preview_file);
    return (path.parent_path() /
            (path.stem().string() + "-dominant-direction" + path.extension().string()))
        .string();
}

void write_previews(const std::string& file, const ibl::PreviewChain& exact,
                    const ibl::PreviewChain& chain, const ibl::CubeMap& irradiance,
                    Session& session) {
    const ibl::BrdfTable table(ibl::BrdfTableKind::kGgx);
    session.timed("preview", [&] {
        write_sheet(file, ibl::filter_preview(exact, chain, table, irradiance));
        session.check_interrupt();
        write_sheet(dominant_direction_file(file),
                    ibl::dominant_direction_preview(chain, table, irradiance, {}, &session));
    });
}

}  // namespace aureole::app
