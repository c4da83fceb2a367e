// A flipbook in a file, in place of computing the PSF of an eye that moves.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "aureole/eye/flipbook.h"
#include "aureole/eye/flipbook_player.h"
#include "aureole/io/binary_file.h"
#include "observer.h"
#include "session.h"

namespace aureole::app {

class EyeBook {
  public:
    // Maps and checks the file. Throws FileError.
    explicit EyeBook(const std::string& path);
    EyeBook(const EyeBook&) = delete;
    EyeBook& operator=(const EyeBook&) = delete;

    // The PSF of an eye as it is now, valid until the next call. Throws InvalidArgument if eye or
    // grid are not the book's; notes where the eye is beyond its range.
    SharedPsf psf(const eye::Eye& now, const eye::SpectralSampling& sampling,
                  const wave::KernelGrid& grid, Session& session);

    const std::string& path() const { return path_; }

  private:
    void open_for(const eye::Eye& eye, const eye::SpectralSampling& sampling,
                  const wave::KernelGrid& grid);

    std::string path_;
    io::MappedFile file_;
    eye::Flipbook book_;
    // For pictures of one size.
    std::optional<eye::FlipbookPlayer> player_;
    std::shared_ptr<wave::Psf> psf_;
};

}  // namespace aureole::app
