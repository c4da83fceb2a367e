#include "aureole/io/display_transform.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"

namespace aureole::io {
namespace ocio = OCIO_NAMESPACE;
namespace {

// Pixels converted at a time: what fits on the stack.
constexpr int kChunk = 1024;

// Linear Rec. 709 (D65, x = .3127, y = .3290) to CIE XYZ, from the primaries by SMPTE RP 177-1993.
// Its white is exactly the D65 of OpenColorIO's transforms, so that grey stays grey; the rounded
// matrix of IEC 61966-2-1 is off by 1e-4.
constexpr std::array<double, 16> kXyzFromRec709 = {0.41239079926595934,
                                                   0.357584339383878,
                                                   0.1804807884018343,
                                                   0,  //
                                                   0.21263900587151027,
                                                   0.715168678767756,
                                                   0.07219231536073371,
                                                   0,  //
                                                   0.01933081871559182,
                                                   0.11919477979462598,
                                                   0.9505321522496607,
                                                   0,  //
                                                   0,
                                                   0,
                                                   0,
                                                   1};

ocio::BuiltinTransformRcPtr builtin(const char* style, ocio::TransformDirection direction) {
    const auto transform = ocio::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

std::string quoted(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
    return text.empty() ? "none" : text;
}

template <class Name>
std::vector<std::string> list(int count, Name&& name) {
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i) names.emplace_back(name(i));
    return names;
}

std::string choose(const char* what, const std::string& wanted, const std::string& fallback,
                   const std::vector<std::string>& offered) {
    const std::string& name = wanted.empty() ? fallback : wanted;
    if (std::find(offered.begin(), offered.end(), name) == offered.end()) {
        throw InvalidArgument(what, name, "the configuration offers " + quoted(offered));
    }
    return name;
}

std::string config_path(const OcioSettings& settings) {
    if (!settings.config.empty()) return settings.config;
    const char* const environment = std::getenv("OCIO");
    if (environment == nullptr || *environment == '\0') {
        throw FileError("OpenColorIO configuration",
                        "none was given, and the environment variable OCIO is not set");
    }
    return environment;
}

}  // namespace

struct DisplayTransform::Impl {
    explicit Impl(const ocio::ConstProcessorRcPtr& processor)
        // Lossless: the fast approximations of powers are meant for 8 and 10 bit pictures.
        : cpu(processor->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS)) {}
    ocio::ConstCPUProcessorRcPtr cpu;
};

DisplayTransform DisplayTransform::aces() {
    const auto to_xyz = ocio::MatrixTransform::Create();
    to_xyz->setMatrix(kXyzFromRec709.data());
    const auto chain = ocio::GroupTransform::Create();
    chain->appendTransform(to_xyz);
    chain->appendTransform(
        builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD", ocio::TRANSFORM_DIR_INVERSE));
    chain->appendTransform(builtin("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0",
                                   ocio::TRANSFORM_DIR_FORWARD));
    chain->appendTransform(builtin("DISPLAY - CIE-XYZ-D65_to_sRGB", ocio::TRANSFORM_DIR_FORWARD));
    try {
        return DisplayTransform(
            std::make_shared<const Impl>(ocio::Config::CreateRaw()->getProcessor(chain)));
    } catch (const ocio::Exception& error) {  // an OpenColorIO before 2.1
        throw Error(std::string("the ACES output transform is not available: ") + error.what());
    }
}

DisplayTransform DisplayTransform::ocio(const OcioSettings& settings) {
    const std::string path = config_path(settings);
    if (!std::filesystem::exists(path)) {
        throw FileError(path, "there is no such OpenColorIO configuration");
    }
    try {
        const ocio::ConstConfigRcPtr config = ocio::Config::CreateFromFile(path.c_str());
        std::string space = settings.input_space.empty() ? "scene_linear" : settings.input_space;
        if (config->getColorSpace(space.c_str()) == nullptr) {
            const auto spaces = list(config->getNumColorSpaces(),
                                     [&](int i) { return config->getColorSpaceNameByIndex(i); });
            const auto roles =
                list(config->getNumRoles(), [&](int i) { return config->getRoleName(i); });
            throw InvalidArgument(
                "input colour space", space,
                "the configuration offers " + quoted(spaces) + " and the roles " + quoted(roles));
        }
        const std::string display =
            choose("display", settings.display, config->getDefaultDisplay(),
                   list(config->getNumDisplays(), [&](int i) { return config->getDisplay(i); }));
        const std::string view =
            choose("view", settings.view, config->getDefaultView(display.c_str()),
                   list(config->getNumViews(display.c_str()),
                        [&](int i) { return config->getView(display.c_str(), i); }));
        return DisplayTransform(std::make_shared<const Impl>(config->getProcessor(
            space.c_str(), display.c_str(), view.c_str(), ocio::TRANSFORM_DIR_FORWARD)));
    } catch (const ocio::Exception& error) {
        throw FileError(path, std::string("cannot be used: ") + error.what());
    }
}

void DisplayTransform::apply(const ConstImageView& rgb, const ImageView& out,
                             float exposure_scale) const noexcept {
    assert(rgb.channels == 3 && out.channels == 3);
    assert(rgb.width == out.width && rgb.height == out.height);
    parallel_for(static_cast<std::size_t>(rgb.height), [&](std::size_t row, int) {
        const int y = static_cast<int>(row);
        std::array<float, 4 * kChunk> pixels;
        for (int begin = 0; begin < rgb.width; begin += kChunk) {
            const int count = std::min(kChunk, rgb.width - begin);
            for (int i = 0; i < count; ++i) {
                float* pixel = pixels.data() + 4 * i;
                for (int c = 0; c < 3; ++c) pixel[c] = rgb.at(begin + i, y, c) * exposure_scale;
                pixel[3] = 1;
            }
            ocio::PackedImageDesc description(pixels.data(), count, 1, 4);
            impl_->cpu->apply(description);
            for (int i = 0; i < count; ++i) {
                const float* pixel = pixels.data() + 4 * i;
                for (int c = 0; c < 3; ++c) out.at(begin + i, y, c) = pixel[c];
            }
        }
    });
}

}  // namespace aureole::io
