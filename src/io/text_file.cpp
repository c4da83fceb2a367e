#include "aureole/io/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "aureole/base/error.h"
#include "io/atomic_file.h"

namespace aureole::io {

std::string read_text_file(const std::string& path) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw FileError(path, "cannot be read: it is a folder");
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file && errno == ENOENT) throw FileError(path, "there is no such file");
    if (!file) throw FileError(path, std::string("cannot be read: ") + std::strerror(errno));
    // In pieces, since pipes and devices do not tell how long they are.
    std::string text;
    std::string piece(65536, '\0');
    while (file) {
        file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
        text.append(piece, 0, static_cast<std::size_t>(file.gcount()));
        if (text.size() > kMostTextBytes) {
            throw FileError(path, fmt::format("is longer than {} MiB", kMostTextBytes >> 20));
        }
    }
    if (file.bad()) throw FileError(path, std::string("cannot be read: ") + std::strerror(errno));
    return text;
}

void write_text_file(const std::string& path, const std::string& text) {
    AtomicFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace aureole::io
