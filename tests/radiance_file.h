// Real HDR pictures for tests of modules that open no files.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "aureole/image/image.h"

namespace aureole {

// The run-length coded Radiance format (Ward 1991, "Real Pixels"), enough of it for the pictures of
// the tests. Empty if the file is missing or something else.
inline Image read_radiance(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string line;
    while (std::getline(file, line) && !line.empty()) continue;
    std::string axis;
    int height = 0;
    int width = 0;
    file >> axis >> height >> axis >> width;
    file.get();
    if (!file) return {};
    Image picture(width, height, 3);
    std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(width));
    for (int y = 0; y < height; ++y) {
        char marks[4];
        file.read(marks, 4);
        for (std::size_t i = 0; i < row.size();) {
            const int count = file.get();
            if (!file) return {};
            if (count > 128) {
                std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(i), count - 128,
                            static_cast<std::uint8_t>(file.get()));
                i += static_cast<std::size_t>(count - 128);
            } else {
                file.read(reinterpret_cast<char*>(row.data() + i), count);
                i += static_cast<std::size_t>(count);
            }
        }
        for (int x = 0; x < width; ++x) {
            const int exponent = row[static_cast<std::size_t>(3 * width + x)];
            for (int c = 0; c < 3; ++c) {
                const int mantissa = row[static_cast<std::size_t>(c * width + x)];
                picture.at(x, y, c) =
                    exponent == 0 ? 0 : std::ldexp(static_cast<float>(mantissa), exponent - 136);
            }
        }
    }
    return picture;
}

}  // namespace aureole
