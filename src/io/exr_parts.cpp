#include "io/exr_parts.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "aureole/base/error.h"

namespace aureole::io {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kTiledFlag = 0x200;  // single-part files only
constexpr std::uint32_t kLongNamesFlag = 0x400;
constexpr std::uint32_t kDeepFlag = 0x800;
constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr std::size_t kShortName = 31;

// Attributes that all parts of a file must agree on (OpenEXR: MultiPartInputFile).
constexpr const char* kShared[] = {"displayWindow", "pixelAspectRatio", "timeCode",
                                   "chromaticities"};

class Reader {
  public:
    Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

    [[noreturn]] void fail() const {
        throw FileError(file_, "truncated or damaged OpenEXR file (near byte " +
                                   std::to_string(std::min(position_, bytes_.size())) + " of " +
                                   std::to_string(bytes_.size()) + ")");
    }
    void seek(std::uint64_t position) {
        if (position > bytes_.size()) fail();
        position_ = static_cast<std::size_t>(position);
    }
    std::size_t position() const { return position_; }
    std::string_view take(std::uint64_t count) {
        if (count > bytes_.size() - position_) fail();
        const std::string_view result = bytes_.substr(position_, static_cast<std::size_t>(count));
        position_ += static_cast<std::size_t>(count);
        return result;
    }
    template <class T>
    T number() {
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    std::string text() {  // up to a null byte
        const std::size_t end = bytes_.find('\0', position_);
        if (end == std::string_view::npos) fail();
        const std::string_view result = take(end - position_);
        take(1);
        return std::string(result);
    }

  private:
    std::string_view bytes_;
    const std::string& file_;
    std::size_t position_ = 0;
};

template <class T>
std::string bytes_of(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
}

std::vector<ExrAttribute> read_header(Reader& reader) {
    std::vector<ExrAttribute> header;
    for (std::string name = reader.text(); !name.empty(); name = reader.text()) {
        std::string type = reader.text();
        const auto size = reader.number<std::int32_t>();
        if (size < 0) reader.fail();
        const auto value = reader.take(static_cast<std::uint64_t>(size));
        header.push_back({std::move(name), std::move(type), std::string(value)});
    }
    return header;
}

std::string_view type_of(const ExrPart& part, bool tiled) {
    const ExrAttribute* type = part.find("type");
    if (type != nullptr) return type->value;
    return tiled ? "tiledimage" : "scanlineimage";
}

// One chunk without its part number, at the reader's position.
std::string_view take_chunk(Reader& reader, std::string_view type) {
    const std::size_t start = reader.position();
    const bool tiled = type == "tiledimage" || type == "deeptile";
    reader.take(tiled ? 16 : 4);  // tile and level coordinates, or y
    std::uint64_t size = 0;
    if (type == "deepscanline" || type == "deeptile") {
        const auto table = reader.number<std::uint64_t>();
        const auto packed = reader.number<std::uint64_t>();
        reader.take(8);  // unpacked size
        if (table > std::numeric_limits<std::uint64_t>::max() - packed) reader.fail();
        size = table + packed;
    } else {
        const auto packed = reader.number<std::int32_t>();
        if (packed < 0) reader.fail();
        size = static_cast<std::uint64_t>(packed);
    }
    reader.take(size);
    const std::size_t end = reader.position();
    reader.seek(start);
    return reader.take(end - start);
}

// Multi-part files say how many chunks a part has. In single-part files the first chunk follows
// the offset table, whose length therefore is known from its smallest entry; entries are increasing
// in files with increasing lines, which is what OpenImageIO writes.
std::vector<std::uint64_t> read_offsets(Reader& reader, const ExrPart& part) {
    std::size_t count = 0;
    if (const ExrAttribute* attribute = part.find("chunkCount")) {
        std::int32_t stored = 0;
        if (attribute->value.size() != sizeof stored) reader.fail();
        std::memcpy(&stored, attribute->value.data(), sizeof stored);
        if (stored < 0) reader.fail();
        count = static_cast<std::size_t>(stored);
    } else {
        const std::size_t start = reader.position();
        const auto first = reader.number<std::uint64_t>();
        if (first < start || (first - start) % 8 != 0) reader.fail();
        reader.seek(start);
        count = (static_cast<std::size_t>(first) - start) / 8;
    }
    const std::string_view table = reader.take(count * sizeof(std::uint64_t));
    std::vector<std::uint64_t> offsets(count);
    if (count > 0) std::memcpy(offsets.data(), table.data(), table.size());
    return offsets;
}

bool long_names(const ExrPart& part) {
    const ExrAttribute* channels = part.find("channels");
    std::size_t longest = 0;
    for (const ExrAttribute& attribute : part.header) {
        longest = std::max({longest, attribute.name.size(), attribute.type.size()});
    }
    // Each channel: name, null, 16 bytes; the list ends with a null.
    for (std::size_t at = 0; channels != nullptr && at < channels->value.size();) {
        const std::size_t end = std::min(channels->value.find('\0', at), channels->value.size());
        longest = std::max(longest, end - at);
        at = end + 17;
    }
    return longest > kShortName;
}

std::string header_bytes(const ExrPart& part) {
    std::string bytes;
    for (const ExrAttribute& attribute : part.header) {
        bytes += attribute.name + '\0' + attribute.type + '\0';
        bytes += bytes_of(static_cast<std::int32_t>(attribute.value.size())) + attribute.value;
    }
    return bytes + '\0';
}

}  // namespace

const ExrAttribute* ExrPart::find(std::string_view name) const {
    const auto at = std::find_if(header.begin(), header.end(),
                                 [&](const ExrAttribute& a) { return a.name == name; });
    return at == header.end() ? nullptr : &*at;
}

void ExrPart::set(std::string_view name, std::string_view type, std::string_view value) {
    std::erase_if(header, [&](const ExrAttribute& a) { return a.name == name; });
    header.push_back({std::string(name), std::string(type), std::string(value)});
}

bool ExrPart::deep() const { return type_of(*this, false).substr(0, 4) == "deep"; }

std::vector<ExrPart> split_exr(std::string_view bytes, const std::string& file) {
    Reader reader(bytes, file);
    if (reader.number<std::uint32_t>() != kMagic) throw FileError(file, "is not an OpenEXR file");
    const auto flags = reader.number<std::uint32_t>();
    const bool multi_part = (flags & kMultiPartFlag) != 0;
    std::vector<ExrPart> parts;
    do {
        std::vector<ExrAttribute> header = read_header(reader);
        if (header.empty()) break;
        parts.push_back({std::move(header), {}});
    } while (multi_part);

    std::vector<std::vector<std::uint64_t>> offsets;
    for (const ExrPart& part : parts) offsets.push_back(read_offsets(reader, part));
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const std::string_view type = type_of(parts[p], (flags & kTiledFlag) != 0);
        for (const std::uint64_t offset : offsets[p]) {
            if (offset == 0) reader.fail();  // a chunk that was never written
            reader.seek(offset);
            if (multi_part && reader.number<std::uint32_t>() != p) reader.fail();
            parts[p].chunks.emplace_back(take_chunk(reader, type));
        }
    }
    return parts;
}

void join_exr(std::vector<ExrPart> parts, std::size_t leader,
              const std::function<void(std::string_view)>& write) {
    std::uint32_t flags = kVersion | kMultiPartFlag;
    std::string headers;
    std::size_t table_bytes = 0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        ExrPart& part = parts[p];
        for (const char* name : kShared) {
            if (p == leader) continue;
            const ExrAttribute* shared = parts[leader].find(name);
            if (shared != nullptr) {
                part.set(name, shared->type, shared->value);
            } else {
                std::erase_if(part.header, [&](const ExrAttribute& a) { return a.name == name; });
            }
        }
        const std::string type(type_of(part, false));
        part.set("type", "string", type);
        part.set("chunkCount", "int", bytes_of(static_cast<std::int32_t>(part.chunks.size())));
        if (long_names(part)) flags |= kLongNamesFlag;
        if (part.deep()) flags |= kDeepFlag;
        headers += header_bytes(part);
        table_bytes += part.chunks.size() * sizeof(std::uint64_t);
    }
    headers += '\0';  // an empty header ends the list
    headers = bytes_of(kMagic) + bytes_of(flags) + headers;

    std::string tables;
    std::uint64_t offset = headers.size() + table_bytes;
    for (const ExrPart& part : parts) {
        for (const std::string& chunk : part.chunks) {
            tables += bytes_of(offset);
            offset += sizeof(std::int32_t) + chunk.size();
        }
    }
    write(headers);
    write(tables);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const std::string number = bytes_of(static_cast<std::int32_t>(p));
        for (const std::string& chunk : parts[p].chunks) {
            write(number);
            write(chunk);
        }
    }
}

}  // namespace aureole::io
