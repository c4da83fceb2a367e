// The error hierarchy. Everything is thrown at construction, parsing or I/O; per-frame calls
// never throw. Every message names what was wrong, the value, and what is allowed.
#pragma once

#include <stdexcept>
#include <string>

namespace aureole {

// Root of everything the library throws on purpose.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

// A parameter outside its range, or parameters that contradict each other.
class InvalidArgument : public Error {
  public:
    // Reads "PARAMETER = VALUE: ALLOWED", for instance "fov_deg = 400: must be in (0, 180)".
    InvalidArgument(const std::string& parameter, const std::string& value,
                    const std::string& allowed)
        : Error(parameter + " = " + value + ": " + allowed) {}
    explicit InvalidArgument(const std::string& message) : Error(message) {}
};

// A file that cannot be read, parsed or written.
class FileError : public Error {
  public:
    // Reads "FILE: REASON".
    FileError(const std::string& file, const std::string& reason)
        : Error(file + ": " + reason), file_(file) {}
    const std::string& file() const noexcept { return file_; }

  private:
    std::string file_;
};

// The caller's Progress asked to stop.
class Cancelled : public Error {
  public:
    Cancelled() : Error("cancelled") {}
};

}  // namespace aureole
