#include "io/readable.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "aureole/base/error.h"

namespace aureole::io {
namespace fs = std::filesystem;

void check_readable(const std::string& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) throw FileError(path, "is a folder, not a picture");
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        if (errno == ENOENT) throw FileError(path, "there is no such file");
        throw FileError(path, std::string("cannot be read: ") + std::strerror(errno));
    }
    ::close(descriptor);
    if (fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) == 0) {
        throw FileError(path, "is empty (0 bytes)");
    }
}

}  // namespace aureole::io
