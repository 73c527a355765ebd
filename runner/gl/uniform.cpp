#include "gl/program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

namespace tidemark::gl {
namespace {

enum class Scalar { float32, int32, uint32, float64 };

/// The component type and count of a uniform type; `columns` > 1 is a square matrix.
struct Shape {
    Scalar scalar;
    int components;
    int columns = 1;
};

Shape shape_of(GLenum type) {
    switch (type) {
    case GL_FLOAT: return {Scalar::float32, 1};
    case GL_FLOAT_VEC2: return {Scalar::float32, 2};
    case GL_FLOAT_VEC3: return {Scalar::float32, 3};
    case GL_FLOAT_VEC4: return {Scalar::float32, 4};
    case GL_FLOAT_MAT4: return {Scalar::float32, 4, 4};
    case GL_UNSIGNED_INT: return {Scalar::uint32, 1};
    case GL_UNSIGNED_INT_VEC2: return {Scalar::uint32, 2};
    case GL_UNSIGNED_INT_VEC3: return {Scalar::uint32, 3};
    case GL_UNSIGNED_INT_VEC4: return {Scalar::uint32, 4};
    case GL_DOUBLE: return {Scalar::float64, 1};
    case GL_DOUBLE_VEC2: return {Scalar::float64, 2};
    case GL_DOUBLE_VEC3: return {Scalar::float64, 3};
    case GL_DOUBLE_VEC4: return {Scalar::float64, 4};
    case GL_DOUBLE_MAT4: return {Scalar::float64, 4, 4};
    case GL_INT_VEC2:
    case GL_BOOL_VEC2: return {Scalar::int32, 2};
    case GL_INT_VEC3:
    case GL_BOOL_VEC3: return {Scalar::int32, 3};
    case GL_INT_VEC4:
    case GL_BOOL_VEC4: return {Scalar::int32, 4};
    default: return {Scalar::int32, 1}; // int, bool, and samplers by their unit
    }
}

/// The longest value the host ever sets: vec3 iChannelResolution[10].
constexpr size_t k_most_numbers = 30;

using Numbers = std::array<double, k_most_numbers>;

/// Copies elements of `width` numbers to elements of `per_element` numbers; missing ones are 0.
Numbers repacked(std::span<const double> values, size_t width, size_t per_element, size_t count) {
    Numbers numbers{};
    for (size_t element = 0; element < count; ++element)
        for (size_t i = 0; i < std::min({width, per_element, values.size() - element * width}); ++i)
            numbers[element * per_element + i] = values[element * width + i];
    return numbers;
}

/// Converts a number. Integer types wrap as in GLSL; for them NaN, infinities and values beyond 64 bits
/// become 0.
template <class T>
T number_of(double value) {
    if constexpr (std::is_floating_point_v<T>)
        return T(value);
    else
        return std::abs(value) < 0x1p63 ? T(int64_t(value)) : T(0);
}

template <class T>
std::array<T, k_most_numbers> converted(const Numbers& values) {
    std::array<T, k_most_numbers> numbers{};
    std::transform(values.begin(), values.end(), numbers.begin(), number_of<T>);
    return numbers;
}

template <class T>
using Setter = void (*)(GLuint, GLint, GLsizei, const T*);

template <class T>
void set_vector(GLuint program, const Uniform& uniform, int components, GLsizei count, const Numbers& values,
                const std::array<Setter<T>, 4>& setters) {
    setters[size_t(components - 1)](program, uniform.location, count, converted<T>(values).data());
}

} // namespace

bool is_number(GLenum type) {
    const Shape shape = shape_of(type);
    const bool scalar =
        type == GL_FLOAT || type == GL_INT || type == GL_UNSIGNED_INT || type == GL_BOOL || type == GL_DOUBLE;
    return shape.columns == 1 && (shape.components > 1 || scalar);
}

void set_uniform(const Program& program, const Uniform& uniform, std::span<const double> given,
                 size_t width) {
    const Shape shape = shape_of(uniform.type);
    const size_t per_element = size_t(shape.components) * size_t(shape.columns);
    if (width == 0)
        width = per_element;
    const size_t room = k_most_numbers / per_element;
    const auto count = GLsizei(std::min({size_t(uniform.length), (given.size() + width - 1) / width, room}));
    if (count == 0)
        return;
    const Numbers values = repacked(given, width, per_element, size_t(count));
    const GLuint id = program.id();
    if (shape.columns == 4 && shape.scalar == Scalar::float32)
        return glProgramUniformMatrix4fv(id, uniform.location, count, GL_FALSE,
                                         converted<float>(values).data());
    if (shape.columns == 4)
        return glProgramUniformMatrix4dv(id, uniform.location, count, GL_FALSE,
                                         converted<double>(values).data());
    switch (shape.scalar) {
    case Scalar::float32:
        return set_vector<float>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1fv, glProgramUniform2fv, glProgramUniform3fv, glProgramUniform4fv});
    case Scalar::float64:
        return set_vector<double>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1dv, glProgramUniform2dv, glProgramUniform3dv, glProgramUniform4dv});
    case Scalar::uint32:
        return set_vector<GLuint>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1uiv, glProgramUniform2uiv, glProgramUniform3uiv, glProgramUniform4uiv});
    case Scalar::int32:
        return set_vector<GLint>(
            id, uniform, shape.components, count, values,
            {glProgramUniform1iv, glProgramUniform2iv, glProgramUniform3iv, glProgramUniform4iv});
    }
}

} // namespace tidemark::gl
