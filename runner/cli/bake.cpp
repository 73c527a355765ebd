// `bake noise`: the texture that scenes read as a channel.

#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "media/generated_textures.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace tidemark::cli {

using namespace host;

namespace fs = std::filesystem;
namespace {

struct BakeOptions {
    fs::path output{}; ///< empty: noise.png
    uint32_t seed = image::k_noise_seed;
};

Result<int> bake_noise(const BakeOptions& options) {
    const OutputPath output = OutputPath::typed_or(options.output, "noise.png");
    const fs::path& path = output.path();
    TRY(image::check_picture_name(path));
    const image::PictureFormat format{image::natural_depth(path), {{"Software", "tidemark bake"}}};
    TRY(image::write_picture(output, image::make_noise(options.seed), format));
    say(fmt::format("wrote {}", path.string()));
    return 0;
}

} // namespace

void add_bake(Command app, Action& chosen) {
    Command command = app.add_subcommand("bake", "Makes the noise texture that scenes read");
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
}

} // namespace tidemark::cli
