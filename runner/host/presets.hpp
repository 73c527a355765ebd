// Presets: views of a scene with names, in a file beside the scene that users may edit and share. The file is
// NAME.presets.json; presets.json for a scene folder.
#pragma once

#include "base/error.hpp"
#include "host/command_line.hpp"
#include "host/moment.hpp"
#include "media/image.hpp"
#include "render/frame_state.hpp"
#include "scene/knob.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::host {

/// A view of a scene: its knobs, definitions, camera, mouse and time.
struct Preset {
    std::string name;
    std::vector<scene::KnobSetting> knobs{}; ///< those that differ from the scene's own defaults
    std::vector<std::string> defines{};      ///< `NAME=VALUE`
    render::OrbitCamera camera{};
    render::Mouse mouse{};
    Extent extent{640, 360}; ///< of the picture that the mouse's pixels refer to
    double seconds = 0;      ///< iTime
    image::Image picture{};  ///< a thumbnail of three channels; without pixels: none
    std::string others{};    ///< unknown fields, as JSON
};

/// Returns a label such as `2.500 s, height = 2`.
std::string label_of(const Preset& preset);

/// Returns the picture in at most `most` pixels, with its shape, as an average of its colours.
image::Image thumbnail_of(const image::Image& picture, Extent most);

/// Returns the path of the file of presets; empty for a scene from standard input, which has none.
std::filesystem::path presets_file(const std::filesystem::path& scene);

Json to_json(const Preset& preset);
/// Fails (ErrorCode::load) where a value has another form than its option.
Result<Preset> preset_of(const Json& json);
/// Returns the preset of a moment, with that name.
Preset preset_of(const Moment& moment, std::string name);

/// The file of presets of one scene.
class PresetFile {
public:
    /// Reads the presets. There are none without a file. Fails (ErrorCode::load) if the file is not one of
    /// presets; it is not written then.
    static Result<PresetFile> read(const std::filesystem::path& scene);

    const std::filesystem::path& path() const { return path_; }
    const std::vector<Preset>& presets() const { return presets_; }

    /// Replaces the presets, completely or not at all. Keeps unknown fields, and presets that another process
    /// has added since. Fails (ErrorCode::write), also if another program has replaced the file by one that
    /// is not of presets.
    Result<void> write(std::vector<Preset> presets);

private:
    explicit PresetFile(std::filesystem::path path) : path_(std::move(path)) {}
    Result<void> load();

    std::filesystem::path path_;
    std::string text_;            ///< of the file, when it was read or written last; empty: none
    std::string others_;          ///< the file's unknown fields, as JSON
    std::vector<Preset> presets_; ///< as of then
};

/// Adds --preset: it gives all options of the command that the user does not give and that the preset holds.
/// To be called after SCENE was added and before the options that a preset gives.
void add_preset_option(Command command, const std::filesystem::path& scene);

/// A change from one view to another over some time, for numbers of knobs and for the camera.
class Morph {
public:
    /// The knobs of the scene, with the values that they have now.
    Morph(const std::vector<scene::Knob>& knobs, const render::OrbitCamera& camera, const Preset& to,
          double begun, double seconds);

    bool done(double now) const { return now >= begun_ + seconds_; }
    /// Returns the values of the knobs that differ, and the camera, at that time.
    std::vector<scene::KnobSetting> knobs(double now) const;
    render::OrbitCamera camera(double now) const;

private:
    struct Turn {
        scene::Knob knob; ///< with the value at the start
        scene::KnobValue to{};
    };
    double share(double now) const;

    std::vector<Turn> turns_;
    render::OrbitCamera from_;
    render::OrbitCamera to_;
    double begun_;
    double seconds_;
};

/// Returns the settings with which a scene with these knobs looks as in the preset: it also resets knobs that
/// options changed and the preset does not hold.
std::vector<scene::KnobSetting> settings_of(const Preset& preset, const std::vector<scene::Knob>& knobs);

} // namespace tidemark::host
