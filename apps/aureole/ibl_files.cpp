#include "ibl_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "aureole/base/error.h"
#include "aureole/ibl/lat_long.h"
#include "aureole/ibl/layout.h"
#include "aureole/io/picture.h"
#include "aureole/io/text_file.h"
#include "option_checks.h"

namespace aureole::app {
namespace {

// In the order of the faces.
constexpr const char* kFaceSuffixes[ibl::kFaces] = {"px", "nx", "py", "ny", "pz", "nz"};

io::TexelFormat texel_format(const std::string& name) {
    if (name == "float") return io::TexelFormat::kFloat;
    if (name == "r11g11b10") return io::TexelFormat::kR11G11B10;
    if (name == "rgb9e5") return io::TexelFormat::kRgb9e5;
    return io::TexelFormat::kHalf;
}

}  // namespace

void IblFileOptions::add_options(CLI::App& command) {
    CLI::Option_group& group = *command.add_option_group("Files");
    one_of(
        group.add_option("--format", format,
                         "dds, ktx2: textures with all levels; exr, hdr: pictures, one per level"),
        {"dds", "ktx2", "exr", "hdr"})
        ->capture_default_str();
    texel_option = one_of(group.add_option("--texel", texel, "Of dds and ktx2"),
                          {"half", "float", "r11g11b10", "rgb9e5"})
                       ->capture_default_str();
    arrange_option =
        one_of(group.add_option("--arrange", arrange,
                                "Of exr and hdr: strip: +X -X +Y -Y +Z -Z side by side; faces: a "
                                "file each; cross; lat-long"),
               {"strip", "faces", "cross", "lat-long"})
            ->capture_default_str();
}

void IblFileOptions::check() const {
    if (!is_texture() && texel_option->count() > 0) {
        throw InvalidArgument("--texel", texel,
                              "applies to dds and ktx2; exr holds floats, hdr its own format");
    }
    if (is_texture() && arrange_option->count() > 0) {
        throw InvalidArgument("--arrange", arrange, "applies to exr and hdr");
    }
}

nlohmann::ordered_json IblFileOptions::parameters() const {
    if (is_texture()) return {{"format", format}, {"texel", texel}};
    return {{"format", format}, {"arrange", arrange}};
}

IblFiles::IblFiles(const std::string& folder, const IblFileOptions& options, Session& session)
    : folder_(folder), options_(options), session_(session), set_(folder) {}

std::string IblFiles::path(const std::string& name) {
    names_.push_back(name);
    return set_.path(name);
}

void IblFiles::write_environment(const ibl::CubeChain& chain) {
    if (!options_.is_texture()) {
        for (std::size_t level = 0; level < chain.size(); ++level) {
            write_cube(fmt::format("level_{}", level), chain[level]);
        }
        return;
    }
    io::Texture texture;
    texture.faces = ibl::kFaces;
    for (const ibl::CubeMap& map : chain) texture.levels.push_back(map.stacked());
    write_texture("environment", texture);
}

void IblFiles::write_irradiance(const ibl::CubeMap& irradiance) {
    if (options_.is_texture()) {
        write_texture("irradiance", {ibl::kFaces, {irradiance.stacked()}});
    } else {
        write_cube("irradiance", irradiance);
    }
}

void IblFiles::write_table(const ibl::BrdfTable& table) {
    // Cloth has one value, and textures two at least: the other is 0.
    Image values(table.size(), table.size(), 2);
    for (int c = 0; c < table.image().channels(); ++c) {
        std::copy_n(table.image().plane(c), values.pixels(), values.plane(c));
    }
    if (options_.is_texture()) {
        io::Texture texture;
        texture.levels.push_back(std::move(values));
        // Two values between 0 and 1: formats of three colours would not do.
        io::TextureOptions as;
        as.format = options_.texel == "float" ? io::TexelFormat::kFloat : io::TexelFormat::kHalf;
        io::write_texture(path("brdf." + options_.format), texture, as);
        return;
    }
    Image picture(values.width(), values.height(), 3);  // B stays 0
    for (int c = 0; c < 2; ++c) {
        std::copy_n(values.plane(c), values.pixels(), picture.plane(c));
    }
    write_picture("brdf", std::move(picture));
}

void IblFiles::write_json(const std::string& name, const nlohmann::ordered_json& json) {
    io::write_text_file(path(name), json.dump(2) + "\n");
}

std::vector<std::string> IblFiles::commit() {
    set_.commit();
    std::vector<std::string> paths;
    for (const std::string& name : names_) {
        paths.push_back((std::filesystem::path(folder_) / name).string());
    }
    return paths;
}

void IblFiles::write_texture(const std::string& name, const io::Texture& texture) {
    const std::string file = name + "." + options_.format;
    io::TextureOptions as;
    as.format = texel_format(options_.texel);
    const io::TextureReport report = io::write_texture(path(file), texture, as);
    if (report.too_large > 0) {
        session_.note(fmt::format(
            "{}: {} samples do not fit {} and were clamped (the largest is {:g}); --texel float "
            "keeps {}",
            file, report.too_large, options_.texel, report.largest,
            options_.texel == "float" ? "all that are finite" : "them"));
    }
    if (report.negative > 0) {
        session_.note(fmt::format("{}: {} negative samples became 0; {} has no sign", file,
                                  report.negative, options_.texel));
    }
    if (report.not_numbers > 0) {
        session_.note(
            fmt::format("{}: {} samples are beyond what floats can compute with and "
                        "became 0; lower --exposure",
                        file, report.not_numbers));
    }
    session_.json()["clamped_samples"][file] = report.clamped();
}

void IblFiles::write_cube(const std::string& name, const ibl::CubeMap& cube) {
    if (options_.arrange == "strip") {
        write_picture(name, ibl::layout_from_cube(cube, ibl::Layout::kHorizontalStrip));
    } else if (options_.arrange == "cross") {
        write_picture(name, ibl::layout_from_cube(cube, ibl::Layout::kHorizontalCross));
    } else if (options_.arrange == "lat-long") {
        write_picture(name, ibl::lat_long_from_cube(cube, 4 * cube.size()));
    } else {
        for (int face = 0; face < ibl::kFaces; ++face) {
            write_picture(name + "_" + kFaceSuffixes[face], copy(cube.face(face)));
        }
    }
}

void IblFiles::write_picture(const std::string& name, Image image) {
    const std::string file = name + "." + options_.format;
    const io::WriteReport report = io::write_picture(path(file), io::Picture(std::move(image)), {});
    if (report.clipped_samples > 0) {
        session_.note(fmt::format("{}: {} samples do not fit its format and were clipped", file,
                                  report.clipped_samples));
    }
    session_.json()["clamped_samples"][file] = report.clipped_samples;
}

}  // namespace aureole::app
