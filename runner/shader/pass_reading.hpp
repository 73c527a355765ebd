// Text of a pass, with Common before it, read once: yields the dialects to try and the source in each.
#pragma once

#include "base/mapped_text.hpp"
#include "scene/scene.hpp"
#include "shader/promote.hpp"
#include "shader/shader_source.hpp"
#include "shader/survey.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// The source for the driver.
struct Assembly {
    text::MappedText source;
    std::vector<KeptHash> hashes{}; ///< hashes that a promoted text keeps in floats
};

/// Keeps references to the scene and the pass, and to itself, so it cannot be moved.
class PassReading {
public:
    PassReading(const scene::Scene& scene, const scene::Pass& pass);
    PassReading(const PassReading&) = delete;
    PassReading& operator=(const PassReading&) = delete;

    /// Returns the dialects to try, the likeliest first; never empty. Use the first one that links; if none
    /// does, the messages for the first one are the best. Hashes that cannot stay in floats are promoted only
    /// in the last dialect.
    std::vector<Dialect> dialects(Precision precision) const;
    /// Fails (ErrorCode::load) if something has no double form; never fails in single precision.
    Result<Assembly> assemble(const Dialect& dialect) const;
    /// Returns errors that no dialect can fix: characters that GLSL does not have, no entry point, or several
    /// (ShaderToy's tabs pasted into one file), each with its place.
    std::vector<Diagnostic> problems() const;
    /// Returns whether a driver would draw some of these problems, and wrongly: non-ASCII characters taken
    /// for blanks, a mainImage with one vector parameter (Mesa 25 links the call, and draws black).
    bool may_be_drawn_wrong() const { return entry_lacks_parameters() || !strange_characters().empty(); }
    /// Returns the first place of a name in the text.
    std::optional<SourceLocation> place_of(std::string_view name) const;
    /// Returns the text as ShaderToy would compile it: GLSL ES 3.00, changed only where Mesa rejects what
    /// ShaderToy accepts. Knobs become constants, as with `export`.
    text::MappedText site_source() const;
    /// Returns whether the text declares or defines a function of that name.
    bool defines_function(std::string_view name) const;
    /// Returns whether the text has its own `main`; it may be written for another host.
    bool has_own_main() const { return !facts_.mains.empty(); }
    /// Returns whether the mouse follows the pointer without a button, as in the other hosts that texts with
    /// only a `main` are written for. Ask Image.
    bool mouse_follows_pointer() const { return has_own_main() && !defines_function("mainImage"); }
    /// Returns whether pixels may keep their previous contents.
    bool discards() const { return facts_.discards; }

private:
    bool entry_lacks_parameters() const;
    std::vector<text::Edit> forms_that_only_the_site_takes() const;
    std::vector<Diagnostic> strange_characters() const;
    std::optional<Diagnostic> shut_out(std::string_view entry) const;

    const scene::Scene& scene_;
    const scene::Pass& pass_;
    text::MappedText text_;
    std::vector<text::Token> tokens_;
    Preprocessed preprocessed_;
    Survey facts_;
};

} // namespace tidemark::glsl
