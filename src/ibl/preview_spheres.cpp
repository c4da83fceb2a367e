#include "ibl/preview_spheres.h"

#include <fmt/format.h>

#include "aureole/base/error.h"

namespace aureole::ibl {
namespace {

constexpr double kGrey = 0.05;
// Tangent of half of the field that kEnvironment shows of the world across a cell.
constexpr double kHalfFieldTangent = 0.57735026918962576;  // 30 deg

void check_range(const char* what, double value, double least, double most) {
    if (value >= least && value <= most) return;
    throw InvalidArgument(what, fmt::format("{}", value),
                          fmt::format("must be in [{}, {}]", least, most));
}

}  // namespace

// The corner of a cell has room for a number.
int preview_cell_px(const PreviewOptions& options) {
    return options.sphere_px + 2 * std::max(1, 3 * options.sphere_px / 32);
}

CellPlace cell_place(const PreviewOptions& options, double x_px, double y_px) {
    const double middle = 0.5 * preview_cell_px(options);
    const double radius = 0.5 * options.sphere_px;
    return {(x_px - middle) / radius, (middle - y_px) / radius};
}

Direction preview_reflection(const Direction& normal) {
    const double twice = 2 * dot(normal, kPreviewView);
    return {twice * normal.x - kPreviewView.x, twice * normal.y - kPreviewView.y,
            twice * normal.z - kPreviewView.z};
}

PreviewBackdrop::PreviewBackdrop(const PreviewOptions& options, const CubeSampler& environment,
                                 double exposure_scale)
    : environment_(options.background == PreviewBackground::kEnvironment ? &environment : nullptr),
      grey_(kGrey / exposure_scale),
      half_cell_(static_cast<double>(preview_cell_px(options)) / options.sphere_px) {}

PreviewRgb PreviewBackdrop::at(const CellPlace& place) const noexcept {
    if (environment_ == nullptr) return {grey_, grey_, grey_};
    const double scale = kHalfFieldTangent / half_cell_;
    const auto rgb = environment_->sample({place.x * scale, place.y * scale, -1}, 0);
    return {rgb[0], rgb[1], rgb[2]};
}

void check_preview(const PreviewOptions& options) {
    if (options.roughness.empty()) throw InvalidArgument("a preview has at least one column");
    if (options.materials.empty()) throw InvalidArgument("a preview has at least one material");
    for (const double roughness : options.roughness) check_range("roughness", roughness, 0, 1);
    for (const PreviewMaterial& material : options.materials) {
        for (const double f0 : material.f0) check_range("f0", f0, 0, 1);
        for (const double albedo : material.albedo) check_range("albedo", albedo, 0, 1);
    }
    check_range("sphere_px", options.sphere_px, 8, 1024);
    check_range("samples_per_side", options.samples_per_side, 1, 16);
    check_range("integral_samples", options.integral_samples, 2, 1048576);
    check_range("difference_gain", options.difference_gain, 1e-6, 1e6);
}

void check_preview(const PreviewChain& chain) {
    if (chain.levels == nullptr || chain.levels->empty()) {
        throw InvalidArgument("levels of " + chain.name, "0",
                              "a chain to preview has at least one");
    }
    const auto levels = chain.levels->size();
    if (chain.roughness.size() != levels) {
        throw InvalidArgument("roughness values of " + chain.name,
                              std::to_string(chain.roughness.size()),
                              fmt::format("must be as many as its levels, {}", levels));
    }
    if (chain.roughness.front() != 0) {
        throw InvalidArgument("roughness of level 0 of " + chain.name,
                              fmt::format("{}", chain.roughness.front()),
                              "must be 0, the environment itself");
    }
    for (std::size_t i = 1; i < levels; ++i) {
        check_range("roughness of a level", chain.roughness[i], chain.roughness[i - 1], 1);
    }
}

double preview_exposure_scale(const CubeMap& environment) {
    const double luminance = color::luminance(mean_radiance(environment));
    return luminance > 0 ? 1 / luminance : 1;
}

PreviewSheet make_preview_sheet(const PreviewOptions& options,
                                const std::vector<std::string>& labels, double exposure_scale) {
    PreviewSheet sheet;
    sheet.cell_px = preview_cell_px(options);
    sheet.exposure_scale = exposure_scale;
    for (const double roughness : options.roughness) {
        sheet.columns.push_back(fmt::format("roughness {:.4g}", roughness));
    }
    for (const PreviewMaterial& material : options.materials) {
        for (const std::string& label : labels) {
            sheet.rows.push_back({fmt::format("{}: {}", material.name, label), {}});
        }
    }
    sheet.pixels = Image(static_cast<int>(sheet.columns.size()) * sheet.cell_px,
                         static_cast<int>(sheet.rows.size()) * sheet.cell_px, 3);
    return sheet;
}

std::vector<double> preview_difference(const PreviewSheet& sheet, const PreviewOptions& options,
                                       int row, int reference) {
    std::vector<double> result;
    const int cell = sheet.cell_px;
    for (int column = 0; column < static_cast<int>(sheet.columns.size()); ++column) {
        double differences = 0;
        double sum = 0;
        for (int y = 0; y < cell; ++y) {
            for (int x = 0; x < cell; ++x) {
                if (!cell_place(options, x + 0.5, y + 0.5).on_sphere()) continue;
                for (int c = 0; c < 3; ++c) {
                    const double truth =
                        sheet.pixels.at(column * cell + x, reference * cell + y, c);
                    const double value = sheet.pixels.at(column * cell + x, row * cell + y, c);
                    differences += std::abs(value - truth);
                    sum += truth;
                }
            }
        }
        result.push_back(sum > 0 ? differences / sum : 0);
    }
    return result;
}

}  // namespace aureole::ibl
