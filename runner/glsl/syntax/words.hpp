// Name tables for the front end: names that desktop drivers reserve, keywords, names of old APIs, brackets.
// ShaderToy's uniforms: scene::k_site_uniforms.
#pragma once

#include "scene/host_uniforms.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace tidemark::glsl {

using scene::k_channel_names;
using scene::k_channel_structs;
using scene::k_site_uniforms;
using scene::SiteUniform;

/// A name of an old API and its current equivalent.
struct OldName {
    std::string_view name;
    std::string_view today;
};

inline constexpr OldName k_old_names[] = {
    {"iGlobalTime", "iTime"},
    {"iGlobalFrame", "iFrame"},
    {"texture2D", "texture"},
    {"textureCube", "texture"},
    {"texture3D", "texture"},
    {"texture2DProj", "textureProj"},
    {"texture2DLod", "textureLod"},
    {"texture2DLodEXT", "textureLod"},
    {"texture2DProjLod", "textureProjLod"},
    {"texture2DProjLodEXT", "textureProjLod"},
    {"textureCubeLod", "textureLod"},
    {"textureCubeLodEXT", "textureLod"},
    {"texture3DLod", "textureLod"},
    {"texture2DGrad", "textureGrad"},
    {"texture2DGradEXT", "textureGrad"},
    {"texture2DGradARB", "textureGrad"},
    {"textureCubeGrad", "textureGrad"},
    {"textureCubeGradEXT", "textureGrad"},
    {"textureCubeGradARB", "textureGrad"},
    {"textureGradEXT", "textureGrad"},
    {"textureLodEXT", "textureLod"},
};

/// Names that ShaderToy texts use legally (or that are at least published there), but that are keywords in
/// some version that Tidemark offers to drivers.
inline constexpr std::string_view k_reserved_words[] = {"packed",
                                                        "row_major",
                                                        "buffer",
                                                        "shared",
                                                        "sample",
                                                        "precise",
                                                        "patch",
                                                        "subroutine",
                                                        "resource",
                                                        "active",
                                                        "filter",
                                                        "input",
                                                        "output",
                                                        "common",
                                                        "partition",
                                                        "dmat2",
                                                        "dmat3",
                                                        "dmat4",
                                                        "superp",
                                                        "coherent",
                                                        "restrict",
                                                        "readonly",
                                                        "writeonly",
                                                        "samplerCubeArray",
                                                        "isamplerCubeArray",
                                                        "usamplerCubeArray",
                                                        "external",
                                                        "interface",
                                                        "cast",
                                                        "noperspective"};

/// Keywords that are neither types nor functions; sorted.
inline constexpr std::string_view k_keywords[] = {
    "break",     "case",   "centroid", "const",   "continue", "default", "discard",   "do",
    "else",      "false",  "flat",     "for",     "highp",    "if",      "in",        "inout",
    "invariant", "layout", "lowp",     "mediump", "out",      "precise", "precision", "return",
    "smooth",    "struct", "switch",   "true",    "uniform",  "void",    "while"};
static_assert(std::ranges::is_sorted(k_keywords));

inline bool is_keyword(std::string_view word) {
    return std::ranges::binary_search(k_keywords, word);
}

inline bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

/// Returns 1 for an opening parenthesis, bracket or brace, -1 for a closing one, else 0.
inline int nesting(std::string_view word) {
    const size_t sign = word.size() == 1 ? std::string_view("([{)]}").find(word[0]) : word.npos;
    return sign == word.npos ? 0 : sign < 3 ? 1 : -1;
}

inline bool is_precision(std::string_view word) {
    return word == "highp" || word == "mediump" || word == "lowp";
}

} // namespace tidemark::glsl
