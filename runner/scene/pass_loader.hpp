// Puts a Scene together: takes passes in any order that refer to each other by number, and sorts them into
// drawing order.
#pragma once

#include "base/error.hpp"
#include "scene/directives.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace tidemark::scene {

/// A pass under construction.
struct Draft {
    Pass pass;                  ///< PassOutput::pass is an index into the drafts
    std::filesystem::path file; ///< its source file; empty for a pass from JSON
    /// Compiled with BUFFER_N defined, as glslViewer compiles the passes in one text.
    std::optional<size_t> buffer{};
};

/// Checks that every pass defines its entry function, sorts the drafts into drawing order (buffers as in
/// `order`, then cubemap, image, sound) and updates their references. An Image pass that a pass reads, even
/// itself, becomes a buffer, shown by a generated Image pass. Fills `passes` and adds the files that channels
/// read to `files`.
Result<void> finish_scene(Scene& scene, std::vector<Draft> drafts, const std::vector<size_t>& order);

/// Adds a file to the scene's files, once.
void note_file(Scene& scene, const std::filesystem::path& file);
/// Adds all files that a channel reads.
void note_files(Scene& scene, const Channel& channel);

// Loads passes from files of their own: reads a file with its includes and directives, and follows its
// channels to the other files that they name.

/// Fills one Scene. Add the passes known beforehand first, then load them one by one in drawing order. A
/// buffer that only a channel names (`#iChannel0 "blur.glsl"`) is loaded once, before the pass that reads it.
class PassLoader {
public:
    PassLoader(Scene& scene, std::filesystem::path folder, const Bounds& bounds,
               Conditional conditional = Conditional::read);

    /// ShaderToy's passes are ordered by name and may read each other freely: a pass drawn later reads this
    /// frame's output. Other files are drawn before those that read them.
    enum class Order { by_name, by_reading };

    /// Adds a pass known beforehand; returns its index among the drafts.
    size_t add(Draft draft, Order order = Order::by_name);
    /// Reads the draft's file, if it has one. A channel that no directive names keeps its input.
    Result<void> load(size_t draft);
    /// Reads a file that precedes the text of all passes, after those read before it. Call it before `load`.
    /// A pass that includes the file itself does not get it a second time.
    Result<void> load_common(const std::filesystem::path& file);
    /// Completes the Scene.
    Result<void> finish();

private:
    struct FileText {
        text::MappedText text;
        Directives directives;
        std::vector<std::filesystem::path> files;
        OtherHosts others{};
    };

    Result<FileText> read(const std::filesystem::path& file, bool common = false);
    /// `image` is Image's file; empty for other passes and Common.
    Result<void> take_size(const Directives& directives, const std::filesystem::path& image);
    Result<void> add_knobs(std::vector<Knob> knobs);
    /// Binds what a text for another host reads: its last frame, and glslViewer's buffers.
    Result<void> bind_other_hosts(size_t draft, const OtherHosts& others);
    Result<void> bind(size_t draft, const Directives& directives);
    Result<ChannelInput> input_of(size_t draft, const Channel& channel, const std::string& source);
    Result<ChannelInput> output_of_file(size_t reader, const std::filesystem::path& file,
                                        const SourceLocation& where);
    Result<ChannelInput> output_of_name(const std::string& source, const SourceLocation& where) const;
    std::string unique_name(const std::filesystem::path& file) const;
    std::string cycle_from(size_t draft) const;

    Scene& scene_;
    const std::filesystem::path folder_; ///< the scene's folder
    const Bounds& bounds_;
    const Conditional conditional_;
    std::vector<Draft> drafts_;
    std::unordered_map<std::string, size_t> knob_of_name_; ///< indices into the scene's knobs
    std::vector<size_t> order_;
    std::vector<size_t> viewer_buffers_; ///< the drafts of BUFFER_0, BUFFER_1 and so on
    std::vector<size_t> loading_;        ///< buffers waiting for those that they read
    struct Common {
        std::filesystem::path file;
        text::MappedText text;
    };
    std::vector<Common> commons_;
    // One entry per draft:
    std::vector<std::vector<std::filesystem::path>> included_;
    std::vector<Order> order_of_;
};

} // namespace tidemark::scene
