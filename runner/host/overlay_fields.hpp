// Fields of the overlay, as plain values: definitions, errors, knobs, views, magnifier, pictures, time.
//
// A `#define` or `const` that is one number, as a field that can be edited.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "host/input_events.hpp"
#include "scene/knob.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::overlay {

struct DefinitionField {
    std::string name;
    double value = 0;
    bool whole = false;    ///< written without a decimal point: it may be an array size or a loop count
    bool held = false;     ///< replaced by --define or an edit, so it differs from the file
    bool changing = false; ///< being edited

    bool operator==(const DefinitionField&) const = default;
};

/// Returns a field, or nothing where the text is not a finite decimal number in GLSL without a suffix.
std::optional<DefinitionField> definition_field(std::string_view name, std::string_view text, bool held);

/// Copies the values that are being edited from `before` to `now`.
void keep_changing(const std::vector<DefinitionField>& before, std::vector<DefinitionField>& now);

/// Returns the value as GLSL text, with a decimal point where the file has one.
std::string text_of(const DefinitionField& field);

// An error with the source line it refers to, as the overlay shows it. Reads no file.

struct ErrorField {
    Diagnostic diagnostic;
    std::string line{};   ///< the author's source line; empty: not known
    bool summary = false; ///< it only sums up the others
};

/// A part of a line that contains the place of an error.
struct Excerpt {
    std::string text; ///< without tabs
    std::string mark; ///< blanks and a caret for the line below; empty: no column is known
};

/// Returns at most `most` characters of the line, including those around `column` (in bytes, from 1; 0:
/// none).
Excerpt excerpt_of(std::string_view line, int column, size_t most);

// A knob as a field that can be edited: its widget and the values it allows. Draws nothing.

/// The MIDI binding of one component of a knob.
struct ControllerField {
    std::string part;
    std::string controller{}; ///< bound to it; empty: none
    bool learning = false;    ///< the next controller that moves will be bound
};

struct KnobField {
    scene::Knob knob; ///< as the scene declares it
    scene::KnobValue value{};
    std::vector<ControllerField> controllers{}; ///< MIDI bindings, one a component; empty: no device

    bool is_turned() const { return value != knob.initial; }
};

enum class Widget { check_box, colour, slider, drag };

/// Returns the widget for a knob: a check box for a range of only two values, a slider for other ranges, a
/// drag field without a range or where its length overflows a double.
Widget widget_of(const scene::Knob& knob);

/// Returns whether the knob's type can hold the number, which may be typed by hand.
bool takes(const scene::Knob& knob, double number);

/// Returns the value nearest to `number` that the knob's step allows, counted from the low end of its range.
double in_steps(const scene::Knob& knob, size_t component, double number);

/// Returns the change for each pixel of dragging, for a field without a range.
double drag_speed(const scene::Knob& knob, size_t component);

// How the large picture is viewed: channels, exposure, the slice of a volume. Draws nothing.

/// A choice of the channels to show.
struct ChannelChoice {
    std::string_view name;
    std::optional<int> channel{}; ///< none: red, green and blue
    std::optional<int> less{};    ///< subtracted from `channel`
};

inline constexpr std::array<ChannelChoice, 11> k_channel_choices{{{"RGB"},
                                                                  {"R", 0},
                                                                  {"G", 1},
                                                                  {"B", 2},
                                                                  {"A", 3},
                                                                  {"R - G", 0, 1},
                                                                  {"R - B", 0, 2},
                                                                  {"R - A", 0, 3},
                                                                  {"G - B", 1, 2},
                                                                  {"G - A", 1, 3},
                                                                  {"B - A", 2, 3}}};

inline constexpr double k_most_stops = 16;

struct LookField {
    size_t channels = 0;        ///< index into k_channel_choices
    double stops = 0;           ///< exposure; in automatic mode the resulting value
    bool automatic = false;     ///< the brightest value is just not clipped
    std::optional<int> slice{}; ///< of a volume; none: the middle one

    bool operator==(const LookField&) const = default;
};

// The pixel under the pointer and those around it, as the magnifier shows them. Reads no picture.

/// The value that a pass wrote into a pixel.
struct PixelValue {
    std::string pass;
    std::vector<float> channels; ///< three for Image, whose alpha is not shown; else four
};

struct MagnifierField {
    using Colour = std::array<unsigned char, 3>;

    host::PointerPosition pointer{};              ///< in the window
    int x = 0;                                    ///< in the picture, from the left
    int y = 0;                                    ///< from the bottom
    Extent cells{};                               ///< odd sizes: pixel x,y is in the middle
    std::vector<std::optional<Colour>> colours{}; ///< bottom row first; none beyond the picture's edge
    std::vector<PixelValue> values{};             ///< the shown pass first
};

/// Formats a value with at most seven digits, so that columns stay aligned; `NaN`, `Inf`, `-Inf`.
std::string number_text(float value);
/// Formats all bits of a value, as in `0x3f800000`.
std::string bits_text(float value);

/// Converts a colour to bytes: clamped to 0..1, NaN as 0.
MagnifierField::Colour colour_of(const float* rgb);

// A texture that a scene draws or reads, as the overlay shows it.

struct PictureField {
    std::string name;                     ///< "Buffer A", "Image iChannel0"
    unsigned texture = 0;                 ///< name of a two-dimensional OpenGL texture
    Extent extent;                        ///< of that texture
    std::string size{};                   ///< of the source: `64x32`, `6 of 1024x1024`, `32x32x32`
    int slices = 1;                       ///< of a volume; else 1
    std::optional<double> milliseconds{}; ///< time to draw it
};

// The time of a scene, as the time bar shows it.

/// Progress towards a frame of a scene with feedback, for which all earlier frames must be drawn.
struct Stepping {
    int frame = 0;
    int last = 0;
};

struct TimeField {
    double seconds = 0;
    int frame = 0;
    bool paused = false;
    double speed = 1;
    bool turns_back = false; ///< no feedback: time may run backwards
    bool has_speed = true;   ///< false while recording or replaying, where frames are counted instead of time
    std::optional<double> loop_from{};
    std::optional<double> loop_to{};
    std::optional<Stepping> stepping{};
    double bar_end = 10;   ///< seconds at the bar's right end
    bool bar_held = false; ///< the bar is pressed, so its end must not move
    double frame_rate = 0; ///< frames a second; 0: not known
};

/// Returns the end of a bar, in seconds: 10, doubled until the time and the loop's end fit.
double bar_end(const TimeField& time);

/// The volume of a scene's sound.
struct SoundField {
    double volume = 1; ///< 0 to 1
    bool muted = false;

    double heard() const { return muted ? 0 : volume; }
    bool operator==(const SoundField&) const = default;
};

/// A view that the user kept.
struct ViewField {
    std::string name;
    std::string label;    ///< `2.500 s, height = 2`
    unsigned texture = 0; ///< name of a two-dimensional OpenGL texture; 0: no thumbnail
    Extent extent{};      ///< of that texture

    bool operator==(const ViewField&) const = default;
};

/// A scene in the gallery.
struct GalleryField {
    std::string name;
    std::string error{};  ///< why it has no thumbnail; empty: it has one, or is still to be drawn
    unsigned texture = 0; ///< name of a two-dimensional OpenGL texture; 0: none yet
    Extent extent{};      ///< of that texture
};

// Lenses: one number per pixel instead of the picture. All texts are ready to be shown.

/// An entry of a lens's legend.
struct LegendField {
    std::optional<std::array<unsigned char, 3>> box{}; ///< its colour, sRGB
    std::string words;
};

/// The legend of the lens on show, or the reason why there is none.
struct LensField {
    std::string title;
    std::string basis{}; ///< unit, and how the numbers are found
    /// Colours of the bar from its low end to its high end; empty: the lens has no bar.
    std::vector<std::array<unsigned char, 3>> bar{};
    std::string low{}, high{};    ///< numbers at the bar's ends
    std::optional<double> mark{}; ///< place of the pixel under the pointer on the bar, 0 to 1
    std::string pointer{};        ///< the number of that pixel; empty: there is none
    std::vector<LegendField> entries{};
    std::string refusal{};  ///< why the scene has no such numbers; empty: it has
    std::string progress{}; ///< what is still being drawn; empty: nothing
};

/// A lens in the list of the controls.
struct LensChoice {
    std::string name;
    std::string description;
    std::string refusal{}; ///< known reason why the scene has no such numbers; empty: none is known
    bool takes_line = false, needs_line = false;
    std::string second{}; ///< label of what may follow the line; empty: nothing
};

/// The list of lenses and the fields beside it.
struct LensChooser {
    std::vector<LensChoice> choices{};
    std::optional<size_t> chosen{}; ///< none: off
    std::string place{};            ///< LINE or FILE:LINE
    std::string variable{};         ///< of `value`: a name; of `branch`: a number
};

/// A line of the text and its share of the work.
struct HotLineField {
    SourceLocation where;
    std::string text;
    double share = 0;          ///< 0 to 1
    std::string share_words{}; ///< in per cent
};

struct HotLinesField {
    bool open = false; ///< they are counted only while they are shown
    std::vector<HotLineField> lines{};
    std::string note{}; ///< for which frame, or why there are none
};

/// Error and time of the last values of a knob that is being turned.
struct FrontField {
    struct Point {
        std::string value;
        double milliseconds = 0; ///< to draw a frame in float
        double error = 0;        ///< RMSE against double, in steps of 1/255
    };
    std::string knob;
    std::vector<Point> points{}; ///< the newest last
};

/// A short message over the picture.
struct MessageField {
    std::string text;
    double opacity = 1; ///< below 1 while it fades
};

} // namespace tidemark::overlay
