// How a frame was drawn, as a few short hashes: the texts of the scene, the bytes of its inputs, its knobs,
// the frame's state, the drawing options and the driver. Two frames with the same fingerprint are the same
// picture; where two differ, the parts say in which respect.
#pragma once

#include "host/json.hpp"
#include "host/requests.hpp"
#include "render/gl_context.hpp"

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::host {

class Fingerprint {
public:
    /// Hashes a scene's texts and inputs, for no device yet. Reads the files that the scene reads.
    static Fingerprint of_scene(const scene::Scene& scene, const std::vector<std::string>& defines,
                                const FrameSequence& frames);
    /// The same, for a device.
    static Fingerprint of_scene(const scene::Scene& scene, const std::vector<std::string>& defines,
                                const FrameSequence& frames, const gl::Capabilities& driver);
    void set_device(const gl::Capabilities& driver);
    /// Adds a hash of other facts that pictures depend on.
    void add(std::string part, const Json& facts);
    /// Returns the fingerprint of one frame of the run.
    Fingerprint of_frame(const render::FrameState& state) const;
    /// Returns the fingerprint of several frames that are one file.
    Fingerprint of_frames(std::span<const render::FrameState> states) const;

    /// Returns only the parts that the static `of_scene` sets.
    Fingerprint of_scene() const;

    /// Returns the text used in a picture's metadata: `text=0123456789abcdef inputs=…`.
    std::string text() const;
    static Fingerprint parse(std::string_view text);

    /// Returns a description of the parts that differ, for example "another text of the scene, other knobs";
    /// empty if none does.
    std::string differences(const Fingerprint& other) const;

    /// Returns a copy with the device hash of `other`.
    Fingerprint on_device_of(const Fingerprint& other) const;

    /// Returns the hash of the device; empty if there is none.
    std::string device() const;

    bool operator==(const Fingerprint&) const = default;

private:
    const std::string* find(std::string_view part) const;

    std::vector<std::pair<std::string, std::string>> parts_; ///< name, hash
};

} // namespace tidemark::host
