// A pass's text, Common in front, read once: for the dialects it may be offered in and for the text in each.
#pragma once

#include "glsl/dialect.hpp"
#include "glsl/double/promote.hpp"
#include "glsl/survey.hpp"
#include "scene/scene.hpp"
#include "text/mapped_text.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// What the driver gets.
struct Assembly {
    text::MappedText source;
    std::vector<KeptHash> hashes{}; ///< what a promoted text leaves in floats
};

/// Refers to the scene and the pass it was made of, and to itself: it stays where it is.
class PassReading {
public:
    PassReading(const scene::Scene& scene, const scene::Pass& pass);
    PassReading(const PassReading&) = delete;
    PassReading& operator=(const PassReading&) = delete;

    /// The dialects worth offering, the likeliest first; never empty. The first that links is the one: when
    /// none does, the first one's messages are the best. Hashes that cannot stay in floats are promoted where
    /// nothing else links.
    std::vector<Dialect> dialects(Precision precision) const;
    /// Fails (ErrorCode::load) where something has no double form; never in single precision.
    Result<Assembly> assemble(const Dialect& dialect) const;
    /// What no dialect can cure: characters that GLSL does not have, no entry point, or several (tabs pasted
    /// into one file), each with its place.
    std::vector<Diagnostic> problems() const;
    /// Whether some of it a driver would draw all the same, and wrong: characters that are taken for blanks,
    /// a mainImage that takes a vector alone (Mesa 25 links the call of ours, and draws black).
    bool may_be_drawn_wrong() const { return entry_lacks_parameters() || !strange_characters().empty(); }
    /// Where a name of the text stands first.
    std::optional<SourceLocation> place_of(std::string_view name) const;
    /// What the site would compile of it: GLSL ES 3.00, and nothing of the text changed. Knobs are the
    /// constants that `export` makes of them.
    text::MappedText site_source() const;
    /// Announces or defines one of that name.
    bool defines_function(std::string_view name) const;
    /// A `main` of the author's own: the text may be another host's.
    bool has_own_main() const { return !facts_.mains.empty(); }
    /// Whether pixels may keep what was drawn there before.
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
