// The SIMD part of Convolver, compiled per instruction set.
//
// Slabs: the half-transformed picture. Slab g of a channel holds frequencies ky = g V .. g V + V-1
// as the V lanes of its elements (2 V floats each), one element per picture column, so that a slab
// is V whole rows ready for the row transform.
#pragma once

#include <cstddef>

#include "aureole/image/image.h"
#include "fourier/line_plan.h"

namespace aureole::fourier {

// The picture side of the column passes. Columns are transformed 2 V at a time: two real columns
// packed into one complex line, V lines at once.
struct ColumnPass {
    const LinePlan* plan;  // down the columns
    int first_row;         // row 0 of the picture is put at this row of the transform, cyclically
    int columns;           // of a slab that exist; columns_in() stores no others
    float lower_by;        // columns_in(): taken off the sample at transform row 0 ...
    int lower_column;      // ... of this picture column; -1: of none
    const float* weights;  // width * height, or null
    float* slabs;
    std::size_t slab_floats;  // one slab, padding included
    int slabs_per_channel;
};

// The row passes on one slab.
struct RowPass {
    const LinePlan* plan;  // along the rows
    int width;             // valid elements of a slab
};

// What one node of a kernel that changes over the picture does to one slab (varying_convolver.h).
struct NodePass {
    const LinePlan* plan;  // along the rows
    int first_source;      // elements of the slab that the node sees ...
    int sources;
    const float* shares;  // ... each times its share
    int margin;           // the first element that the node reaches is first_source - margin
    int targets;
};

struct ConvolverKernels {
    int lanes;
    // Picture columns [2 V batch, 2 V (batch + 1)) of every channel into the slabs.
    // Scratch: (channels + 1) * 2 V * (plan length + 1) floats.
    void (*columns_in)(const ColumnPass& pass, const ConstImageView& in, int batch, float* scratch);
    // Back into the picture, plus peaks[channel] times the input.
    void (*columns_out)(const ColumnPass& pass, const ConstImageView& in, const float* peaks,
                        const ImageView& out, int batch, float* scratch);
    // Convolves a slab with the kernel's spectrum, in place. Scratch: 2 V * plan length floats.
    void (*convolve_rows)(const RowPass& pass, float* slab, const float* spectrum, float* scratch);
    // The same for `channels` slabs at once, slab_floats apart, with a matrix of spectra: channel c
    // becomes the sum over j of channel j convolved with that at spectrum + (channels j + c)
    // spectrum_floats. Scratch: (channels + 1) * 2 V * plan length floats.
    void (*mix_rows)(const RowPass& pass, int channels, float* slab, std::size_t slab_floats,
                     const float* spectrum, std::size_t spectrum_floats, float* scratch);
    // Turns a slab of the kernel into its spectrum, in place: column x of the slab is put at column
    // first + x of the transform, cyclically. `slab`: 2 V * plan length floats.
    void (*spectrum_rows)(const RowPass& pass, int first_column, float scale, float* slab,
                          float* scratch);
    // Adds a node's light to the slab `sum`. `spectrum` is one of a pair made by even_spectra: its
    // second begins V floats after the first. Scratch: 4 V * plan length floats.
    void (*convolve_node)(const NodePass& pass, const float* slab, const float* spectrum,
                          float* sum, float* scratch);
    // The spectra, real, of a kernel that a half turn does not change, centred at column 0 of the
    // transform, from two slabs of its columns 0 to `reach` (`second` may be null: zeros).
    // `spectra`: 2 V * plan length floats, V of the first slab and V of the second in each element.
    // Scratch: as much.
    void (*even_spectra)(const LinePlan& plan, int reach, float scale, const float* first,
                         const float* second, float* spectra, float* scratch);
};

ConvolverKernels convolver_kernels();

}  // namespace aureole::fourier
