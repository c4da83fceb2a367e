#include "gallery.h"

namespace aureole::app {

std::span<const Case> gallery_cases() {
    static constexpr Case kCases[] = {
        {"large-source", "Large sources",
         "A source as large as the sun on a bright and on a dark ground, eye open and blinking.",
         "A blink of 0.33 s before the lamp, eight times slower.", 4, large_source_case},
        {"stars", "Stars and other small sources",
         "Sources smaller than a pixel: faint, medium and bright, on grounds of several "
         "luminances. A faint one shows the small inner needles and no more, because nothing else "
         "rises above the ground.",
         "Stars that drift by an eighth of a pixel per frame: nothing flickers.", 4, stars_case},
        {"colors", "Colours of sources",
         "Azure, orange and apple green, the colours that break without high dynamic range, and "
         "the hues in between. All lights have the same largest component.",
         "The hue goes once around.", 3, colors_case},
        {"sizes", "Sizes of sources",
         "Three sources of equal luminance and different sizes; from column to column "
         "they are brighter, below as people say they see them (vivid). "
         "The energy of glare is proportional to the area of its source.",
         "Three sources grow from 0.05 deg.", 3, sizes_case},
        {"brightness", "Brightness of sources",
         "Three sources of equal size and different luminance; from column to column they are "
         "larger, below as people say they see them (vivid).",
         "Three sources brighten by three decades.", 3, brightness_case},
        {"water", "Glints on water",
         "The sun on waves, near and far: hundreds of small sources that come and go. The glints "
         "and their glare are as white as the sun.",
         "Waves in real time, seen by an eye whose pupil trembles.", 3, water_case},
        {"candle", "A candle",
         "The flame is higher than wide: it smooths the needles that point sideways and keeps "
         "those that point up and down. Its light has the spectrum of a glowing body (tungsten).",
         "The flame trembles, and the needles shimmer with the eye.", 2, candle_case},
        {"occlusion", "Partial occlusion",
         "A lamp behind an opaque plate, behind one with holes and behind one that lets half of "
         "the light through; an orange lamp that keeps its colour behind one.",
         "The lamp goes behind the opaque plate.", 4, occlusion_case},
        {"sunset", "A sunset",
         "The sun goes down into the sea: from 5 deg to -0.2 deg its luminance falls by a factor "
         "of some seventy and its colour goes from a light to a deep orange, without any step. The "
         "picture "
         "is exposed for the sky.",
         "The same in 48 steps, smaller ones towards the end, until the sun has gone.", 3,
         sunset_case},
    };
    return kCases;
}

}  // namespace aureole::app
