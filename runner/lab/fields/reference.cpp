#include "lab/fields/reference.hpp"

#include "base/try.hpp"
#include "glsl/overrides.hpp"
#include "lab/fields/field_text.hpp"
#include "lab/fields/gerstner_waves_field.hpp"
#include "lab/fields/procedural_ocean_field.hpp"
#include "lab/fields/water_surface_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

namespace tidemark::lab {
namespace {

/// A definition that may vary without another field: the reference reads it, or it is how nearly the scene
/// computes what the reference has exactly. For the hash it has the first value.
struct FreeDefinition {
    std::string_view name;
    int hashed;
    int low, high; ///< what the reference knows
    bool octaves;
};

struct KnownText {
    std::string_view hash;
    bool sine_lattice = false;
    bool turning_poles = false;
    bool drift_wraps = false;
};

/// Who edits a field's text reads it against its reference anew and puts its hash here: the test of
/// references prints it.
struct KnownField {
    MakeReference make;
    std::vector<FreeDefinition> free;
    std::vector<KnownText> texts;
};

const std::vector<KnownField>& known_fields() {
    static const std::vector<KnownField> k_fields = {
        {water_surface_reference,
         {{"OCTAVES", 7, 1, 12, true}},
         {{"c5a755ae20877cf2b54e023612c91f292dcf6db709e408a8c73f42bcd70948b8"},
          {"49bc271ddcfaa09814fc30828edceef2f7e897c509734e217ddfc9020ad17e22", false, true},
          {"aac94ac70de83dc987ee7e947f354779d0458a23d3012c0a1d518f950ac4490d", true, false},
          {"13279926e9be071dd123de017d3d54f20730fe80c9f7c19cbd9299765b8508ea", true, true},
          {"1478872d530b8b68ad327c18f255673badeb7597e0c98bc74bf03a3765fe6543", false, false, true},
          {"9df3a1e9e8440206d289a34faa13657c8172adc3c00a0e14e0518c6c3200b123", false, true, true},
          {"083fa1de740411c90c67581d9db50984a5b32e48c7f51975ece974edba6c876b", true, false, true},
          {"74243a11e5dcd821bb760bec07296f70d21a161a464e2a9d6c8bf6349996a756", true, true, true}}},
        {gerstner_waves_reference,
         {{"NEWTON_STEPS", 4, 1, 1 << 16, false}},
         {{"6c664fd496d80ee86971a299567dc8d1422849a81fbfb5905540790783501418"}}},
        {procedural_ocean_reference,
         {{"OCTAVES", 3, 1, 8, true}, {"FINE_OCTAVES", 5, 1, 64, false}},
         {{"4dba349a35350f30723cc5fc622f6683f6615e1127a091d2282b914e5ef6d7a8"}}},
    };
    return k_fields;
}

std::optional<int> plain_number(const std::string& text) {
    int number = 0;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
}

/// The scene with all free definitions at those values.
scene::Scene with_values(scene::Scene scene, const std::vector<FreeDefinition>& free,
                         const std::vector<int>& values) {
    for (size_t i = 0; i < free.size(); ++i)
        (void)glsl::override_definition(scene, fmt::format("{}={}", free[i].name, values[i]));
    return scene;
}

/// The values that the scene gives them, where the reference knows them.
Result<std::vector<int>> values_of(const scene::Scene& scene, const std::vector<FreeDefinition>& free) {
    std::vector<int> values;
    for (const FreeDefinition& definition : free) {
        const std::string text = glsl::definition_of(scene, definition.name).value_or(std::string());
        const auto number = plain_number(text);
        if (!number)
            return fail(
                ErrorCode::load,
                fmt::format("the reference reads {0} as a plain number, not as '{1}': give one with --define "
                            "{0}=N, or write it so",
                            definition.name, text));
        if (*number < definition.low || *number > definition.high)
            return fail(ErrorCode::load,
                        fmt::format("the reference knows {} from {} to {}, and it is {}", definition.name,
                                    definition.low, definition.high, *number));
        values.push_back(*number);
    }
    return values;
}

/// What of `scene` is not in the hash: the free definitions must mean what they seem to, everywhere.
Result<FoundReference> bind(const scene::Scene& scene, const KnownField& field, const KnownText& text) {
    const auto values = TRY(values_of(scene, field.free));
    const auto as_it_is = field_hash(scene), as_read = field_hash(with_values(scene, field.free, values));
    if (!as_it_is || !as_read || *as_it_is != *as_read)
        return fail(ErrorCode::load, "a definition that the reference reads has several values");
    FoundReference found{field.make, std::string(text.hash), text.sine_lattice, text.turning_poles,
                         text.drift_wraps};
    for (size_t i = 0; i < field.free.size(); ++i)
        if (field.free[i].octaves)
            found.octaves = values[i];
    return found;
}

} // namespace

Result<FoundReference> find_reference(const scene::Scene& scene) {
    std::string last;
    for (const KnownField& field : known_fields()) {
        std::vector<int> hashed;
        for (const FreeDefinition& definition : field.free)
            hashed.push_back(definition.hashed);
        const auto hash = TRY(field_hash(with_values(scene, field.free, hashed)));
        const auto known = std::ranges::find(field.texts, hash, &KnownText::hash);
        if (known != field.texts.end())
            return bind(scene, field, *known);
        last = hash;
    }
    return fail(ErrorCode::load,
                fmt::format("no reference was written for the text of this field (SHA-256 {}...)",
                            last.substr(0, 12)));
}

} // namespace tidemark::lab
