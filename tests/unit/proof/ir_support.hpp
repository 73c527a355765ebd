// Small fragment shaders for the tests of ir: a body between the declarations that all of them have.
#pragma once

#include "proof/march_slice.hpp"
#include "proof/spirv.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tidemark::proof {

inline std::string shader(const std::string& functions, const std::string& main) {
    return "#version 450 core\n"
           "uniform float iTime;\n"
           "uniform sampler2D iChannel0;\n"
           "layout(location = 0) out vec4 color;\n" +
           functions + "\nvoid main() {\n" + main + "\n}\n";
}

inline Function compiled(const std::string& functions, const std::string& main) {
    auto function = compile(shader(functions, main));
    EXPECT_TRUE(function) << function.error().message;
    return function ? *std::move(function) : Function();
}

/// A ray down the z axis through x, with a march of that body: `t` is the way, `map` the field.
inline Function marcher(const std::string& field, const std::string& march) {
    return compiled("float map(vec3 p) { return " + field + "; }",
                    "vec3 ro = vec3(gl_FragCoord.x, 0.0, -3.0), rd = vec3(0.0, 0.0, 1.0);\n"
                    "float t = 0.0;\n" +
                        march + "\ncolor = vec4(t);");
}

/// The usual one.
inline const std::string k_sphere_tracing =
    "for (int i = 0; i < 100; ++i) { float d = map(ro + rd * t); if (d < 0.001 || t > 20.0) break; t += d; }";

/// Returns the evaluator of a pixel that has entered the first of the loops.
inline FloatEvaluator entered(const Function& function, const std::vector<MarchingLoop>& loops, float x,
                              float time = 0) {
    FloatEvaluator evaluator(function);
    const auto set = [&](const char* name, float value) {
        if (const Variable* variable = function.find(name))
            evaluator.memory()[variable->first].real = value;
    };
    set("gl_FragCoord", x);
    set("iTime", time);
    EXPECT_TRUE(enter_first(evaluator, loops));
    return evaluator;
}

} // namespace tidemark::proof
