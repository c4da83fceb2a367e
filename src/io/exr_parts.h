// The container of OpenEXR files, as bytes: how the parts of a multi-part file that are not
// processed travel to the output exactly as they were, whatever they hold (tiles, mip levels, deep
// samples, any compression), none of which OpenImageIO can copy without loss.
// Layout: "OpenEXR File Layout", openexr.com/en/latest/OpenEXRFileLayout.html.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace aureole::io {

struct ExrAttribute {
    std::string name;
    std::string type;
    std::string value;  // raw, little endian
};

struct ExrPart {
    std::vector<ExrAttribute> header;
    std::vector<std::string> chunks;  // in the order of the offset table, without part numbers

    const ExrAttribute* find(std::string_view name) const;
    void set(std::string_view name, std::string_view type, std::string_view value);
    bool deep() const;
};

// Cuts a file into its parts. `file` names it in messages.
// Throws FileError if anything does not fit: truncated, incomplete or not OpenEXR.
std::vector<ExrPart> split_exr(std::string_view bytes, const std::string& file);

// The bytes of a multi-part file, in pieces passed to `write`. Sets what such files must have
// (type, chunkCount; names must be set and differ), and gives all parts the windows and other
// attributes that the format demands be shared from part `leader`.
void join_exr(std::vector<ExrPart> parts, std::size_t leader,
              const std::function<void(std::string_view)>& write);

}  // namespace aureole::io
