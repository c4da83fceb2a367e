// A cube map on which every place has a name, for tests of orientation.
#pragma once

#include <cmath>

#include "aureole/ibl/cube_map.h"

namespace aureole::ibl {

// Each quarter of each face has a colour of its own: red says the face, 1 to 6, green the quarter
// in reading order, 1 to 4, blue is one of 24 values without any pattern, so that none of the 48
// symmetries of a cube leaves the map as it is.
inline float label_blue(int face, int quarter) {
    return static_cast<float>((7 * (4 * face + quarter) + 5) % 24 + 1);
}

inline CubeMap labelled_cube(int size) {
    CubeMap map(size);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const int quarter = 2 * (2 * y / size) + 2 * x / size;
                map.at(face, x, y, 0) = static_cast<float>(face + 1);
                map.at(face, x, y, 1) = static_cast<float>(quarter + 1);
                map.at(face, x, y, 2) = label_blue(face, quarter);
            }
        }
    }
    return map;
}

// All quarters have their colours at their middles, to `tolerance`.
inline bool has_labels_in_place(const CubeMap& map, float tolerance) {
    const int size = map.size();
    for (int face = 0; face < kFaces; ++face) {
        for (int quarter = 0; quarter < 4; ++quarter) {
            const int x = size / 4 + quarter % 2 * (size / 2);
            const int y = size / 4 + quarter / 2 * (size / 2);
            const float label[3] = {static_cast<float>(face + 1), static_cast<float>(quarter + 1),
                                    label_blue(face, quarter)};
            for (int c = 0; c < 3; ++c) {
                if (!(std::abs(map.at(face, x, y, c) - label[c]) <= tolerance)) return false;
            }
        }
    }
    return true;
}

}  // namespace aureole::ibl
