#include "aureole/ibl/preview.h"

#include <fmt/format.h>

#include <cmath>

#include "aureole/base/error.h"
#include "aureole/base/units.h"
#include "aureole/ibl/dominant_direction.h"
#include "aureole/ibl/roughness.h"
#include "ibl/preview_spheres.h"
#include "ibl/specular_integral.h"

namespace aureole::ibl {
namespace {

// A white environment's share by scale and bias, whatever the kind of the table.
struct BrdfTerms {
    double scale = 0;
    double bias = 0;
};

BrdfTerms terms_at(const BrdfTable& table, double n_dot_v, double roughness) {
    const auto [first, second] = table.lookup(n_dot_v, roughness);
    if (table.kind() == BrdfTableKind::kGgx) return {first, second};
    return {second - first, first};
}

void check(const BrdfTable& table) {
    if (table.kind() != BrdfTableKind::kCloth) return;
    throw InvalidArgument("kind of the table", "cloth", "must be ggx or multiscatter");
}

PreviewRgb widened(const std::array<float, 3>& rgb) { return {rgb[0], rgb[1], rgb[2]}; }

// What the sheets have in common: a material under light that is given by its specular part, of
// which it reflects `reflected`, and by irradiance.
void add_matt_layer(const PreviewMaterial& material, const PreviewRgb& irradiance,
                    const PreviewRgb& reflected, PreviewRgb& sum) {
    for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += material.albedo[c] * irradiance[c] / kPi * (1 - reflected[c]);
    }
}

// f0 A + B.
PreviewRgb single_scattering(const PreviewMaterial& material, const BrdfTerms& terms) {
    PreviewRgb result;
    for (std::size_t c = 0; c < 3; ++c) {
        result[c] = material.f0[c] * terms.scale + terms.bias;
    }
    return result;
}

// With the light that leaves the surface after several reflections between its facets: Turquin
// 2019, "Practical Multiple Scattering Compensation for Microfacet Models", eq. 16.
PreviewRgb all_scattering(const PreviewMaterial& material, const BrdfTerms& terms) {
    PreviewRgb result = single_scattering(material, terms);
    for (std::size_t c = 0; c < 3; ++c) {
        result[c] *= 1 + material.f0[c] * (1 / (terms.scale + terms.bias) - 1);
    }
    return result;
}

std::vector<double> levels_of(const PreviewChain& chain, const PreviewOptions& options) {
    std::vector<double> levels;
    for (const double roughness : options.roughness) {
        levels.push_back(level_of_roughness(chain.roughness, roughness));
    }
    return levels;
}

void paint_difference(PreviewSheet& sheet, int row, double gain) {
    const int cell = sheet.cell_px;
    for (int c = 0; c < 3; ++c) {
        for (int y = row * cell; y < (row + 1) * cell; ++y) {
            const float* const method = sheet.pixels.row(y - cell, c);
            const float* const reference = sheet.pixels.row(y - 2 * cell, c);
            float* const out = sheet.pixels.row(y, c);
            for (int x = 0; x < sheet.pixels.width(); ++x) {
                out[x] = static_cast<float>(gain) * std::abs(method[x] - reference[x]);
            }
        }
    }
}

}  // namespace

PreviewMaterial preview_gold() { return {"gold", {1.00, 0.71, 0.29}, {0, 0, 0}}; }

PreviewMaterial preview_plastic() { return {"plastic", {0.04, 0.04, 0.04}, {0.5, 0.5, 0.5}}; }

PreviewSheet filter_preview(const PreviewChain& reference, const PreviewChain& method,
                            const BrdfTable& table, const CubeMap& irradiance,
                            const PreviewOptions& options) {
    check_preview(options);
    check(table);
    check_preview(reference);
    check_preview(method);
    const CubeSampler reference_sampler(*reference.levels);
    const CubeSampler method_sampler(*method.levels);
    const CubeSampler irradiance_sampler({irradiance});
    const std::vector<double> reference_level = levels_of(reference, options);
    const std::vector<double> method_level = levels_of(method, options);

    PreviewSheet sheet = make_preview_sheet(
        options,
        {reference.name, method.name, fmt::format("difference x {:.4g}", options.difference_gain)},
        preview_exposure_scale(reference.levels->front()));
    const PreviewBackdrop backdrop(options, reference_sampler, sheet.exposure_scale);
    const auto shade = [&](std::size_t column, const Direction& normal, int, std::uint32_t,
                           PreviewRgb* sums) {
        const Direction along = preview_reflection(normal);
        const PreviewRgb light[2] = {
            widened(reference_sampler.sample(along, reference_level[column])),
            widened(method_sampler.sample(along, method_level[column]))};
        const PreviewRgb matt = widened(irradiance_sampler.sample(normal, 0));
        const BrdfTerms terms = terms_at(table, normal.z, options.roughness[column]);
        for (const PreviewMaterial& material : options.materials) {
            const PreviewRgb reflected = all_scattering(material, terms);
            for (const PreviewRgb& rgb : light) {
                for (std::size_t c = 0; c < 3; ++c) (*sums)[c] += rgb[c] * reflected[c];
                add_matt_layer(material, matt, reflected, *sums);
                ++sums;
            }
        }
    };
    paint_spheres(sheet, options, backdrop, 3, 2, shade, nullptr);
    for (int row = 2; row < static_cast<int>(sheet.rows.size()); row += 3) {
        paint_difference(sheet, row, options.difference_gain);
        sheet.rows[static_cast<std::size_t>(row)].difference =
            preview_difference(sheet, options, row - 1, row - 2);
    }
    return sheet;
}

PreviewSheet dominant_direction_preview(const PreviewChain& chain, const BrdfTable& table,
                                        const CubeMap& irradiance, const PreviewOptions& options,
                                        Progress* progress) {
    check_preview(options);
    check(table);
    check_preview(chain);
    const CubeMap& environment = chain.levels->front();
    const CubeSampler sampler(*chain.levels);
    const CubeSampler irradiance_sampler({irradiance});
    const SpecularIntegral integral(environment);
    const std::vector<double> level = levels_of(chain, options);

    PreviewSheet sheet =
        make_preview_sheet(options, {"N = V = R", "dominant direction", "whole integral"},
                           preview_exposure_scale(environment));
    const PreviewBackdrop backdrop(options, sampler, sheet.exposure_scale);
    const int samples = options.samples_per_side * options.samples_per_side;
    const int each = 2 * std::max(1, (options.integral_samples / samples + 1) / 2);
    const auto shade = [&](std::size_t column, const Direction& normal, int sample,
                           std::uint32_t pixel, PreviewRgb* sums) {
        const double roughness = options.roughness[column];
        const double alpha = alpha_from_roughness(roughness);
        const Direction mirror = preview_reflection(normal);
        const PreviewRgb light[2] = {
            widened(sampler.sample(mirror, level[column])),
            widened(
                sampler.sample(specular_dominant_direction(normal, mirror, alpha), level[column]))};
        const SpecularRadiance whole =
            integral.estimate(normal, kPreviewView, alpha, sample * each, each, pixel);
        const PreviewRgb matt = widened(irradiance_sampler.sample(normal, 0));
        const BrdfTerms terms = terms_at(table, normal.z, roughness);
        for (const PreviewMaterial& material : options.materials) {
            const PreviewRgb reflected = single_scattering(material, terms);
            for (int row = 0; row < 3; ++row) {
                for (std::size_t c = 0; c < 3; ++c) {
                    (*sums)[c] += row < 2 ? light[row][c] * reflected[c]
                                          : material.f0[c] * whole.scale[c] + whole.bias[c];
                }
                add_matt_layer(material, matt, reflected, *sums);
                ++sums;
            }
        }
    };
    paint_spheres(sheet, options, backdrop, 3, 3, shade, progress);
    for (int row = 0; row < static_cast<int>(sheet.rows.size()); ++row) {
        const int reference = row / 3 * 3 + 2;
        if (row == reference) continue;
        sheet.rows[static_cast<std::size_t>(row)].difference =
            preview_difference(sheet, options, row, reference);
    }
    return sheet;
}

}  // namespace aureole::ibl
