// From a light to where its ghosts are and how bright.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lens/matrix_chords.h"
#include "lens/matrix_colors.h"
#include "lens/matrix_ghosts.h"
#include "lens/matrix_open_area.h"
#include "lens/matrix_path.h"
#include "lens/matrix_pupil.h"

namespace aureole::lens {

class MatrixPlacement {
  public:
    // `pupil` must live as long.
    MatrixPlacement(const Lens& lens, const Film& film, const Pupil& pupil,
                    std::span<const Bounces> ghosts);

    // Allocates nothing. `placements` and `entrances`: one per ghost.
    void place(const sources::Light& light, std::span<MatrixGhost> placements,
               std::span<Entrance> entrances) noexcept;

    const MatrixColors& colors() const { return colors_; }

  private:
    // What all ghosts of one light share.
    struct Source {
        double slope_x, slope_y;  // of its rays
        double slope, angle_rad;
        double along_u, along_v;  // direction of the slope
        double irradiance[3];     // on the front, per that of the film
        double moment_xx, moment_xy, moment_yy;
        bool extended;
    };
    void place_one(const Source& source, std::size_t index, MatrixGhost& ghost,
                   Entrance& entrance) noexcept;
    bool open_round(const Source& source, std::size_t index, MatrixGhost& ghost,
                    OpenArea& open) noexcept;
    bool open_stretched(const Source& source, const MatrixPath& path, MatrixGhost& ghost) noexcept;
    std::span<const LineDisc> discs_of(std::size_t ghost) const {
        return std::span(unit_discs_)
            .subspan(first_disc_[ghost], first_disc_[ghost + 1] - first_disc_[ghost]);
    }
    static MatrixGhost::Clip clip_of(const Source& source, const MatrixPath& path,
                                     const ClipPath& clip);
    static void blur(const Source& source, const MatrixPath& path, MatrixGhost& ghost);

    const Pupil& pupil_;
    Film film_;
    std::vector<MatrixPath> paths_;
    MatrixColors colors_;
    double iris_reach_ = 1;
    // Iris and clips of each ghost, for a slope of 1.
    std::vector<LineDisc> unit_discs_;
    std::vector<std::size_t> first_disc_;  // of each ghost, and the end
    std::vector<LineDisc> discs_, scratch_;
    std::optional<IrisChords> chords_;  // of an iris with blades
    OpenArea whole_;                    // of a ghost that nothing clips, without dirt
};

}  // namespace aureole::lens
