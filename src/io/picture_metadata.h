// What a Picture carries without showing it: internal to the module, because OpenImageIO's headers
// are heavy.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "aureole/io/picture.h"
#include "io/exr_parts.h"

namespace aureole::io {

// How a channel goes back to an EXR file.
struct ChannelStorage {
    OIIO::TypeDesc type = OIIO::TypeUnknown;  // unknown: as WriteOptions::depth says
    // Of a uint channel (ids): its values, because float holds whole numbers to 2^24 only. Used
    // where the float sample still is what it was when read.
    std::shared_ptr<const std::vector<std::uint32_t>> exact;
};

struct OtherParts {
    std::vector<ExrPart> parts;  // the one that was read has no chunks here
    std::size_t leader = 0;      // which that is
};

struct PictureMetadata {
    OIIO::ParamValueList attributes;
    std::vector<ChannelStorage> storage;      // one per channel of the picture
    std::shared_ptr<const OtherParts> parts;  // null unless the file had several
};

// How the reader and the writer get at it.
struct PictureAccess {
    static const PictureMetadata& metadata(const Picture& picture) { return *picture.metadata_; }
    static PictureMetadata& own_metadata(Picture& picture) { return picture.own_metadata(); }
};

}  // namespace aureole::io
