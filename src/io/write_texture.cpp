#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "aureole/base/error.h"
#include "aureole/base/parallel.h"
#include "aureole/io/texture.h"
#include "io/atomic_file.h"
#include "io/texel.h"
#include "io/texture_container.h"

namespace aureole::io {
namespace {

constexpr std::size_t kBytesAtOnce = std::size_t{4} << 20;

enum class Container { kDds, kKtx2 };

Container container_of(const std::string& path) {
    const std::size_t start = path.find_last_of("./");
    if (start != std::string::npos && path[start] == '.') {
        const std::string extension = path.substr(start + 1);
        if (OIIO::Strutil::iequals(extension, "dds")) return Container::kDds;
        if (OIIO::Strutil::iequals(extension, "ktx2")) return Container::kKtx2;
    }
    throw InvalidArgument("texture file", path, "must end in .dds or .ktx2");
}

StoredTexture checked_shape(const Texture& texture) {
    if (texture.faces != 1 && texture.faces != 6) {
        throw InvalidArgument("faces of a texture", std::to_string(texture.faces),
                              "must be 1 or 6");
    }
    if (texture.levels.empty() || texture.levels.front().empty()) {
        throw InvalidArgument("a texture must have a level 0 with texels");
    }
    const Image& base = texture.levels.front();
    StoredTexture stored;
    stored.width = static_cast<std::uint32_t>(base.width());
    stored.faces = static_cast<std::uint32_t>(texture.faces);
    stored.height = static_cast<std::uint32_t>(base.height()) / stored.faces;
    stored.levels = static_cast<std::uint32_t>(texture.levels.size());
    if (texture.faces == 6 && base.height() != 6 * base.width()) {
        throw InvalidArgument("level 0 of a cube map",
                              fmt::format("{}x{}", base.width(), base.height()),
                              "must be six squares below one another");
    }
    const std::uint32_t side = std::max(stored.width, stored.height);
    if (side > kMostTexels) {
        throw InvalidArgument("side of a texture", std::to_string(side),
                              fmt::format("must be at most {}", kMostTexels));
    }
    const auto most_levels = static_cast<std::uint32_t>(std::bit_width(side));
    if (stored.levels > most_levels) {
        throw InvalidArgument("levels of a texture", std::to_string(stored.levels),
                              fmt::format("must be at most {} for {}x{} texels", most_levels,
                                          stored.width, stored.height));
    }
    for (std::uint32_t k = 0; k < stored.levels; ++k) {
        const Image& level = texture.levels[k];
        const auto width = static_cast<int>(stored.level_width(k));
        const auto height = static_cast<int>(stored.level_height(k) * stored.faces);
        if (level.width() == width && level.height() == height &&
            level.channels() == base.channels()) {
            continue;
        }
        throw InvalidArgument(
            fmt::format("level {} of a texture", k),
            fmt::format("{}x{}, {} channels", level.width(), level.height(), level.channels()),
            fmt::format("must be {}x{}, {} channels", width, height, base.channels()));
    }
    return stored;
}

void add(const TextureReport& part, TextureReport& whole) {
    whole.too_large += part.too_large;
    whole.negative += part.negative;
    whole.not_numbers += part.not_numbers;
    whole.largest = std::max(whole.largest, part.largest);
}

class TexelWriter {
  public:
    TexelWriter(const Texture& texture, const StoredTexture& stored, AtomicFile& file)
        : texture_(texture), stored_(stored), file_(file) {}

    void write(std::uint32_t level, std::uint32_t face) {
        const Image& image = texture_.levels[level];
        const int first = static_cast<int>(face * stored_.level_height(level));
        const int end = first + static_cast<int>(stored_.level_height(level));
        const auto row_bytes = static_cast<std::size_t>(stored_.row_bytes(level));
        const int at_once = std::max(1, static_cast<int>(kBytesAtOnce / row_bytes));
        for (int begin = first; begin < end; begin += at_once) {
            const auto rows = static_cast<std::size_t>(std::min(at_once, end - begin));
            bytes_.resize(std::max(bytes_.size(), rows * row_bytes));
            std::vector<TextureReport> reports(rows);
            parallel_for(rows, [&](std::size_t row, int) {
                encode_row(stored_.texel, image, begin + static_cast<int>(row),
                           bytes_.data() + row * row_bytes, reports[row]);
            });
            for (const TextureReport& part : reports) add(part, report_);
            file_.write(bytes_.data(), rows * row_bytes);
        }
    }

    const TextureReport& report() const { return report_; }

  private:
    const Texture& texture_;
    const StoredTexture& stored_;
    AtomicFile& file_;
    std::vector<std::byte> bytes_;
    TextureReport report_;
};

}  // namespace

void check_texture_extension(const std::string& path) { container_of(path); }

TextureReport write_texture(const std::string& path, const Texture& texture,
                            const TextureOptions& options) {
    const Container container = container_of(path);
    StoredTexture stored = checked_shape(texture);
    const NamedLayout& layout = written_layout(options.format, texture.levels.front().channels());
    stored.texel = layout.layout;

    AtomicFile file(path);
    TexelWriter texels(texture, stored, file);
    if (container == Container::kDds) {
        const std::string header = dds_header(stored, layout);
        file.write(header.data(), header.size());
        for (std::uint32_t face = 0; face < stored.faces; ++face) {
            for (std::uint32_t level = 0; level < stored.levels; ++level) texels.write(level, face);
        }
    } else {
        std::vector<std::uint64_t> offsets;
        const std::string header = ktx2_header(stored, layout, offsets);
        file.write(header.data(), header.size());
        for (std::uint32_t level = stored.levels; level-- > 0;) {
            const std::string padding(static_cast<std::size_t>(offsets[level]) - file.size(), '\0');
            file.write(padding.data(), padding.size());
            for (std::uint32_t face = 0; face < stored.faces; ++face) texels.write(level, face);
        }
    }
    file.commit();
    return texels.report();
}

}  // namespace aureole::io
