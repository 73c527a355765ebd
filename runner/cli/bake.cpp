// `bake noise` and `bake ramps`: the pictures that scenes read.

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "media/baked_textures.hpp"
#include "media/generated_textures.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace tidemark::cli {

namespace fs = std::filesystem;
namespace {

struct BakeOptions {
    fs::path output{}; ///< empty: the command's default
    uint32_t seed = image::k_noise_seed;
};

Result<int> write(const OutputPath& output, const image::Image& image) {
    const fs::path& path = output.path();
    TRY(image::check_picture_name(path));
    const auto depth =
        image.type == image::SampleType::f32 ? image::SampleDepth::u16 : image::natural_depth(path);
    const image::PictureFormat format{depth, {{"Software", "tidemark bake"}}};
    TRY(image::write_picture(output, image, format));
    say(fmt::format("wrote {}", path.string()));
    return 0;
}

Result<int> bake_noise(const BakeOptions& options) {
    return write(OutputPath::typed_or(options.output, "noise.png"), image::make_noise(options.seed));
}

Result<int> bake_ramps(const BakeOptions& options) {
    for (const bake::NamedImage& ramp : bake::make_ramps())
        if (auto written = write(OutputPath::typed(options.output) / (ramp.name + ".png"), ramp.image);
            !written)
            return written;
    return 0;
}

} // namespace

void add_bake(Command app, Action& chosen) {
    Command command = app.add_subcommand("bake", "Makes the textures that scenes need");
    command.require_subcommand();

    auto noise = std::make_shared<BakeOptions>();
    Command noise_command =
        command.add_subcommand("noise", "Makes the 256x256 noise texture that channels read by default");
    noise_command.add_option("-o,--output", noise->output, "File [noise.png]").type_name("FILE");
    noise_command.add_option("--seed", noise->seed, "Seed: each gives another noise of the same kind")
        .check(number<uint32_t>("a whole number from 0"))
        .type_name("N")
        .capture_default_str();
    noise_command.on_call([noise, &chosen] { chosen = [noise] { return bake_noise(*noise); }; });

    auto ramps = std::make_shared<BakeOptions>();
    ramps->output = ".";
    Command ramps_command = command.add_subcommand(
        "ramps", "Makes the ramps of shaders/pseudo3d_water.glsl and stylized_waves.glsl");
    ramps_command.add_option("-o,--output", ramps->output, "Folder")
        .type_name("FOLDER")
        .capture_default_str();
    ramps_command.on_call([ramps, &chosen] { chosen = [ramps] { return bake_ramps(*ramps); }; });
}

} // namespace tidemark::cli
