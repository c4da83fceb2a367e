// Files of bytes that other modules take apart.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace aureole::io {

// A file seen as memory: nothing is read until it is looked at, and runs that map one file share
// it. The file must not become shorter meanwhile (a program that looks at what is gone is stopped
// by the system); files that appear by a rename, as all of ours do, never do.
class MappedFile {
  public:
    // Throws FileError if the file is missing, a folder, empty, or cannot be mapped.
    explicit MappedFile(const std::string& path);
    ~MappedFile();
    MappedFile(MappedFile&&) noexcept;
    MappedFile& operator=(MappedFile&&) noexcept;

    // Begins at a page of the system.
    std::span<const std::byte> bytes() const noexcept { return bytes_; }

  private:
    std::span<const std::byte> bytes_;
};

// The file appears whole or not at all (io/picture.h). Throws FileError.
void write_binary_file(const std::string& path, std::span<const std::byte> bytes);

}  // namespace aureole::io
