// Explains why two devices draw a scene differently: draws it on the first device with models of what GLSL
// leaves to a device, and finds the model, and the lines, that change the differing pixels. A context must be
// current.
#pragma once

#include "base/error.hpp"
#include "lab/probe_bench.hpp"
#include "render/frame_state.hpp"
#include "shader/variation.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// A pixel is the same on two devices if no sample differs by more than one step of 8 bits.
inline constexpr double k_same_pixel = 1.0 / 255;
/// The share of the differing pixels that causes have to move to explain the difference.
inline constexpr double k_explained_share = 0.9;

/// A freedom of devices that a changed text imitates; the cause is named as `check` names its probe.
struct Model {
    std::string name;
    glsl::VariedArithmetic arithmetic;
};
/// Returns the models of any device (device_drawing.cpp). `functions`: also other sines, quotients, roots,
/// powers and logarithms.
std::vector<Model> device_models(bool functions);
/// Returns the models that are tried beside SwiftShader's own arithmetic.
std::vector<Model> models_beside_swiftshader();
/// Returns the last resort: a text that amplifies the last bits of what it computes or is given.
std::vector<Model> last_bit_models();

/// Something that GLSL leaves to a device, and its effect on the differing pixels.
struct DeviceCause {
    std::string name; ///< as `check` names the probe that warns of it, for example `sine`
    std::string says; ///< for example "sines a unit in the last place smaller"
    std::string pass{};
    std::vector<SourceLocation> places{}; ///< the lines that carry it, at most three
    double moved = 0; ///< share of the differing pixels that it changes, or whose neighbours it changes
    bool reproduced = false; ///< with it, the first device draws the same as the second
};

struct DeviceDifference {
    size_t pixels = 0;
    size_t differing = 0; ///< pixels of Image that differ by more than k_same_pixel
    double largest = 0;   ///< of a sample as shown
    double psnr = 0;      ///< dB, as shown; infinite: the same
    double flip = 0;
    size_t not_finite_here = 0;  ///< pixels that are NaN or infinite on the first device only
    size_t not_finite_there = 0; ///< and on the second one only
    bool equal = false;          ///< the same bytes of 8 bits
    std::vector<DeviceCause> causes{};
    double explained =
        0; ///< share of the differing pixels, of Image or of the causes' buffer, that they move
    std::string problem{}; ///< why the text could not be varied; empty: it could
    bool too_slow = false; ///< a pass takes so long that no model was tried: draw a smaller picture
    Extent examined{0, 0}; ///< the size at which the causes were found; 0x0: that of the pictures
    /// No pass differs if it reads the other device's previous frame: an earlier frame has the cause.
    bool begins_earlier = false;
    std::optional<int> frame{}; ///< the earlier frame at which the causes were found
};

// Pictures of two devices, and textures (device_drawing.cpp).

/// The pictures of a frame, cubemaps excepted.
struct FramePictures {
    std::vector<PassPicture> passes;
    std::vector<PassPicture> before{}; ///< the same passes after the previous frame; empty without feedback
};

/// Draws a state as ProbeBench::passes does, and reads the previous frame too if the scene has feedback.
Result<FramePictures> draw_frame(ProbeBench& bench, const FrameState& state);

/// One flag per pixel.
using Mask = std::vector<bool>;
size_t count(const Mask& mask);
Mask both(const Mask& left, const Mask& right);
Mask either(const Mask& left, const Mask& right);

/// Image is compared as shown, a buffer as the numbers that it holds.
enum class PictureKind { image, buffer };

/// Returns the largest difference of samples of a pixel that is the same on both.
double same_pixel(PictureKind kind);
/// Returns the pixels in which a sample differs by more than `limit`; alpha counts in buffers only.
Mask differing(const image::Image& left, const image::Image& right, double limit, PictureKind kind);
/// Returns the pixels of the mask and their eight neighbours.
Mask grown(const Mask& mask, Extent extent);
/// Returns `here` as it is, or rounded to 8 bits if `there` comes from such a file.
image::Image comparable(const image::Image& here, const image::Image& there);
/// Returns the picture of the pass with that name; null: there is none.
const image::Image* picture_of(const std::vector<PassPicture>& passes, std::string_view name);

/// Puts the other device's pictures into the textures that a pass reads: of passes drawn before it those of
/// the same frame, of itself and of later passes those of the previous frame. Returns whether it put any.
bool use_pictures(const render::Renderer& renderer, size_t pass, const FramePictures& there);

/// Returns the value of glsl::Variation::filters_uniform for the pass with that number.
int filters_of(const render::Renderer& renderer, const scene::Pass& pass, size_t number);

/// The mipmaps of a pass's textures of bytes, with each texel rounded to the nearest byte or as the driver
/// makes them.
class ExactMipmaps {
public:
    ExactMipmaps(const render::Renderer& renderer, size_t pass);
    bool any() const { return !textures_.empty(); }
    /// Returns whether any texture that the pass reads has mipmaps, of bytes or not.
    bool any_levels() const { return any_levels_; }
    void use(bool exact);

private:
    std::vector<const gl::Texture*> textures_;
    bool any_levels_ = false;
    bool exact_ = false;
};

/// Compares Image of the two devices: RGB floats.
Result<DeviceDifference> compare_devices(const image::Image& here, const image::Image& there);

/// The driver of the other device. For SwiftShader, whose functions are imitated bit for bit, models that
/// only guess at functions are not tried; nor are they for a device whose functions have the same bits.
enum class OtherDevice { unknown, swiftshader, same_functions };

/// Called with what is known so far, before the lines of causes are searched: that may take long.
using SeeCauses = std::function<void(const DeviceDifference&)>;

/// Finds the causes of a difference of Image. `there` is what the other device drew in that state, as by
/// draw_frame. A frame with feedback is drawn from the other device's previous frame.
Result<void> explain(DeviceDifference& difference, ProbeBench& bench, const FrameState& state,
                     const FramePictures& there, OtherDevice other = OtherDevice::unknown,
                     const SeeCauses& see = {});

/// A text whose Image is white where sines are SwiftShader's, else black.
extern const std::string_view k_swiftshader_test;
/// A text whose red shows ten functions, one a row, of 64 numbers each that no compiler knows.
extern const std::string_view k_functions_test;
inline constexpr Extent k_functions_extent{64, 10};

} // namespace tidemark::lab
