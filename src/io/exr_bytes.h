// An uncompressed OpenEXR file made byte by byte, after "OpenEXR File Layout": an oracle for the
// reader that shares no code with it.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace aureole::io {

template <class T>
std::string little_endian(T value) {
    std::string bytes(sizeof(T), '\0');
    std::memcpy(bytes.data(), &value, sizeof(T));
    return bytes;
}

struct ExrBytes {
    enum Type : std::int32_t { kUint = 0, kHalf = 1, kFloat = 2 };
    struct Channel {  // to be listed in alphabetical order
        std::string name;
        Type type = kFloat;
        std::string (*sample)(int x, int y) = nullptr;  // x, y in the coordinates of the windows
    };
    std::int32_t data[4] = {0, 0, 0, 0};  // left, top, right, bottom: inclusive
    std::int32_t display[4] = {0, 0, 0, 0};
    std::vector<Channel> channels;
    std::string more_attributes;

    static std::string attribute(const std::string& name, const std::string& type,
                                 const std::string& value) {
        return name + '\0' + type + '\0' + little_endian(static_cast<std::int32_t>(value.size())) +
               value;
    }
    static std::string box(const std::int32_t (&window)[4]) {
        std::string bytes;
        for (const std::int32_t value : window) bytes += little_endian(value);
        return bytes;
    }

    std::string bytes() const {
        std::string list;
        for (const Channel& channel : channels) {
            list += channel.name + '\0' + little_endian<std::int32_t>(channel.type) +
                    std::string(4, '\0') + little_endian<std::int32_t>(1) +
                    little_endian<std::int32_t>(1);
        }
        list += '\0';
        std::string file = little_endian<std::int32_t>(20000630) + little_endian<std::int32_t>(2);
        file += attribute("channels", "chlist", list);
        file += attribute("compression", "compression", std::string(1, '\0'));
        file += attribute("dataWindow", "box2i", box(data));
        file += attribute("displayWindow", "box2i", box(display));
        file += attribute("lineOrder", "lineOrder", std::string(1, '\0'));
        file += attribute("pixelAspectRatio", "float", little_endian(2.0F));
        file += attribute("screenWindowCenter", "v2f", std::string(8, '\0'));
        file += attribute("screenWindowWidth", "float", little_endian(0.5F));
        file += more_attributes + '\0';

        std::string lines;
        std::string table;
        const auto rows = static_cast<std::size_t>(data[3] - data[1] + 1);
        for (std::int32_t y = data[1]; y <= data[3]; ++y) {
            table += little_endian<std::uint64_t>(file.size() + 8 * rows + lines.size());
            std::string line;
            for (const Channel& channel : channels) {
                for (std::int32_t x = data[0]; x <= data[2]; ++x) line += channel.sample(x, y);
            }
            lines +=
                little_endian(y) + little_endian(static_cast<std::int32_t>(line.size())) + line;
        }
        return file + table + lines;
    }
};

}  // namespace aureole::io
