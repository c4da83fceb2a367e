#include "golden.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "aureole/io/picture.h"

namespace aureole::golden {
namespace {

struct Worst {
    int x = 0, y = 0, c = 0;
    double excess = 0;  // error over what is allowed
};

}  // namespace

testing::AssertionResult matches(const std::string& name, const ConstImageView& actual,
                                 const Tolerance& tolerance) {
    namespace fs = std::filesystem;
    const fs::path stored = fs::path(AUREOLE_GOLDENS) / (name + ".exr");
    if (std::getenv("AUREOLE_UPDATE_GOLDENS") != nullptr) {
        fs::create_directories(stored.parent_path());
        io::write_picture(stored.string(), io::Picture(copy(actual)), {.depth = io::Depth::kHalf});
        return testing::AssertionSuccess() << "stored " << stored;
    }
    const io::Picture picture = io::read_picture(stored.string());
    const ConstImageView expected = picture.color();
    if (expected.width != actual.width || expected.height != actual.height ||
        expected.channels != actual.channels) {
        return testing::AssertionFailure()
               << fmt::format("{}: {}x{} with {} channels, stored: {}x{} with {}", name,
                              actual.width, actual.height, actual.channels, expected.width,
                              expected.height, expected.channels);
    }
    double brightest = 0;
    for (int c = 0; c < expected.channels; ++c) {
        for (int y = 0; y < expected.height; ++y) {
            for (int x = 0; x < expected.width; ++x) {
                brightest =
                    std::max(brightest, std::abs(static_cast<double>(expected.at(x, y, c))));
            }
        }
    }
    Image difference(actual.width, actual.height, actual.channels);
    Worst worst;
    std::size_t off = 0;
    for (int c = 0; c < expected.channels; ++c) {
        for (int y = 0; y < expected.height; ++y) {
            for (int x = 0; x < expected.width; ++x) {
                const double want = expected.at(x, y, c);
                const double error = actual.at(x, y, c) - want;
                difference.at(x, y, c) = static_cast<float>(error);
                const double allowed =
                    tolerance.relative * std::abs(want) + tolerance.floor * brightest;
                const double excess = std::isfinite(error) ? std::abs(error) / allowed : INFINITY;
                if (excess > 1) ++off;
                if (excess > worst.excess) worst = {x, y, c, excess};
            }
        }
    }
    const double share = static_cast<double>(off) /
                         static_cast<double>(actual.pixels() * static_cast<std::size_t>(3));
    if (share <= tolerance.outliers) return testing::AssertionSuccess();

    const fs::path folder = AUREOLE_GOLDEN_FAILURES;
    fs::create_directories(folder);
    const auto write = [&](const char* kind, const ConstImageView& image) {
        io::write_picture((folder / fmt::format("{}-{}.exr", name, kind)).string(),
                          io::Picture(copy(image)));
    };
    write("actual", actual);
    write("expected", expected);
    write("difference", difference);
    return testing::AssertionFailure() << fmt::format(
               "{}: {:.3g} % of the values are off (allowed: {:.3g} %); the worst is ({}, {}) "
               "channel {}: {} instead of {}, {:.3g} times the tolerance; pictures in {}",
               name, 100 * share, 100 * tolerance.outliers, worst.x, worst.y, worst.c,
               actual.at(worst.x, worst.y, worst.c), expected.at(worst.x, worst.y, worst.c),
               worst.excess, folder.string());
}

}  // namespace aureole::golden
