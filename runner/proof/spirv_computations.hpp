// Reads a SPIR-V module, second and third layer: variables and pointers into them, and computations on known
// values.
#pragma once

#include "proof/spirv_values.hpp"

#include <bit>

namespace tidemark::proof {

/// A place in memory, fixed or with a computed offset.
struct Pointer {
    Id type = 0; ///< of the target
    uint32_t first = 0;
    Value offset = k_no_value;
    uint32_t last = 0; ///< last cell that the offset may reach
    std::string sampler{};
};

class SpirvMemory : protected SpirvValues {
protected:
    bool read_memory(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpVariable: declare(each); return true;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain: pointers_[each.at(1)] = chain(each); return true;
        case spv::OpLoad: load(each); return true;
        case spv::OpStore: store(each); return true;
        case spv::OpCopyMemory: {
            const Pointer from = pointer(each.at(1));
            write(pointer(each.at(0)), read_from(from));
            return true;
        }
        default: return false;
        }
    }

    bool has_pointer(Id id) const { return pointers_.contains(id); }
    const Pointer& pointer(Id id) const {
        const auto found = pointers_.find(id);
        if (found == pointers_.end())
            cannot("an unknown pointer");
        return found->second;
    }

    void same_pointer(Id id, Id as) { pointers_[id] = pointer(as); }

    void declare(const SpirvInstruction& each) {
        const Id pointee = types_.part(each.at(0), 0);
        const Type& of = type(pointee);
        Pointer& place = pointers_[each.at(1)];
        place = {pointee, cells(), k_no_value, cells() + std::max(1u, of.count) - 1, {}};
        if (of.kind == Type::Kind::sampler) {
            place.sampler = names_[each.at(1)];
            return;
        }
        if (of.count > k_most_cells - cells())
            cannot("too large an array");
        function().variables.push_back(variable(each, of, pointee));
        append_scalars(pointee, function().cells);
        if (each.words.size() > 3)
            initialisers_.emplace_back(each.at(1), each.at(3));
        if (in_function_)
            initialise();
    }

    Variable variable(const SpirvInstruction& each, const Type& of, Id pointee) {
        Variable result{Variable::Kind::local, names_[each.at(1)], cells(), of.count, of.scalar};
        switch (spv::StorageClass(each.at(2))) {
        case spv::StorageClassUniformConstant:
        case spv::StorageClassUniform: result.kind = Variable::Kind::uniform; break;
        case spv::StorageClassInput: result.kind = Variable::Kind::input; break;
        case spv::StorageClassOutput: result.kind = Variable::Kind::output; break;
        default: break;
        }
        const bool array = of.kind == Type::Kind::array;
        result.length = array ? of.parts : 0;
        const Type& element = array ? type(types_.part(pointee, 0)) : of;
        result.columns = element.kind == Type::Kind::matrix ? element.parts : 1;
        result.rows = result.columns == 0 ? 0 : element.count / result.columns;
        return result;
    }

    /// Writes the initial values of global variables at the start of the function.
    void initialise() {
        for (const auto& [variable, value_id] : std::exchange(initialisers_, {}))
            write(pointer(variable), values(value_id));
    }

    Pointer chain(const SpirvInstruction& each) {
        Pointer place = pointer(each.at(2));
        for (const Id index : each.from(3)) {
            const Instruction known = function().instructions[value(index)];
            const Id part = types_.part(place.type, known.immediate);
            if (known.op == Op::constant || type(place.type).kind == Type::Kind::record) {
                const uint32_t within = types_.offset(place.type, constant_of(index));
                if (within >= std::max(1u, type(place.type).count))
                    cannot("an index out of range");
                place.first += within;
                if (place.offset == k_no_value)
                    place.last = place.first + std::max(1u, type(part).count) - 1;
            } else {
                move(place, value(index), type(part).count, type(place.type).parts);
            }
            place.type = part;
        }
        return place;
    }

    /// Moves the place by a computed index, which is clamped to its array.
    void move(Pointer& place, Value index, uint32_t stride, uint32_t count) {
        const auto number = [&](uint32_t bits) { return build_.constant(bits, Scalar::signed_int); };
        const auto whole = [&](Op op, Value a, Value b) {
            return build_.add(op, Scalar::signed_int, {a, b});
        };
        if (build_.type_of(index) == Scalar::unsigned_int)
            index = build_.add(Op::bits_as, Scalar::signed_int, {index});
        const Value inside = whole(Op::minimum, whole(Op::maximum, index, number(0)), number(count - 1));
        const Value offset = whole(Op::multiply, inside, number(stride));
        if (place.offset == k_no_value)
            place.last = place.first + stride * count - 1;
        place.offset = place.offset == k_no_value ? offset : whole(Op::add, place.offset, offset);
    }

    uint32_t access(const Pointer& place, uint32_t component) {
        const uint32_t first = place.first + component;
        if (first > place.last || place.last >= cells())
            cannot("an index out of range");
        function().accesses.push_back({first, place.offset == k_no_value ? 1 : place.last - first + 1});
        return uint32_t(function().accesses.size() - 1);
    }

    Values read_from(const Pointer& place) {
        Values result;
        const std::vector<Scalar> kinds = scalars(place.type);
        for (uint32_t i = 0; i < kinds.size(); ++i) {
            Values operands;
            if (place.offset != k_no_value)
                operands.push_back(place.offset);
            result.push_back(build_.add(Op::load, kinds[i], operands, access(place, i)));
        }
        return result;
    }

    void write(const Pointer& place, const Values& what) {
        for (uint32_t i = 0; i < what.size(); ++i) {
            Values operands{what[i]};
            if (place.offset != k_no_value)
                operands.push_back(place.offset);
            build_.add(Op::store, build_.type_of(what[i]), operands, access(place, i));
        }
    }

    void load(const SpirvInstruction& each) {
        const Pointer place = pointer(each.at(2));
        if (type(place.type).kind == Type::Kind::sampler)
            pointers_[each.at(1)] = place;
        else
            define(each, read_from(place));
    }
    void store(const SpirvInstruction& each) { write(pointer(each.at(0)), values(each.at(1))); }

    bool in_function_ = false;

private:
    static constexpr uint32_t k_most_cells = 1 << 20;

    uint32_t cells() { return uint32_t(function().cells.size()); }

    std::unordered_map<Id, Pointer> pointers_;
    std::vector<std::pair<Id, Id>> initialisers_;
};

class SpirvComputations : protected SpirvMemory {
protected:
    Values computed(const SpirvInstruction& each) {
        const Scalar result = type(each.at(0)).scalar;
        if (each.op == spv::OpExtInst)
            return called(each, result);
        if (const auto op = proof::componentwise(each.op))
            return componentwise(*op, result, each.from(2));
        switch (each.op) {
        case spv::OpCopyObject: return values(each.at(2));
        case spv::OpFOrdGreaterThan:
        case spv::OpSGreaterThan:
        case spv::OpUGreaterThan:
            return build_.each(Op::less, result, {values(each.at(3)), values(each.at(2))});
        case spv::OpFOrdGreaterThanEqual:
        case spv::OpSGreaterThanEqual:
        case spv::OpUGreaterThanEqual:
            return build_.each(Op::less_equal, result, {values(each.at(3)), values(each.at(2))});
        case spv::OpAny: return {folded(Op::logical_or, values(each.at(2)))};
        case spv::OpAll: return {folded(Op::logical_and, values(each.at(2)))};
        case spv::OpFwidth:
        case spv::OpFwidthFine:
        case spv::OpFwidthCoarse: return width_of(values(each.at(2)));
        default: return composite(each);
        }
    }

    Values componentwise(Op op, Scalar result, std::span<const Id> ids) {
        std::vector<Values> operands;
        for (const Id id : ids)
            operands.push_back(values(id));
        return build_.each(op, result, operands);
    }

    Value folded(Op op, const Values& bits) {
        Value result = bits[0];
        for (size_t i = 1; i < bits.size(); ++i)
            result = build_.add(op, Scalar::boolean, {result, bits[i]});
        return result;
    }

    Values width_of(const Values& a) {
        const auto change = [&](Op along) {
            return build_.each(Op::absolute, Scalar::real, {build_.each(along, Scalar::real, {a})});
        };
        return build_.each(Op::add, Scalar::real, {change(Op::derivative_x), change(Op::derivative_y)});
    }

    Values composite(const SpirvInstruction& each) {
        switch (each.op) {
        case spv::OpCompositeConstruct: return together(each.from(2));
        case spv::OpCompositeExtract: return extract(each.at(2), each.from(3));
        case spv::OpCompositeInsert: return insert(each);
        case spv::OpVectorShuffle: return shuffle(each);
        case spv::OpVectorExtractDynamic: return {component(values(each.at(2)), value(each.at(3)))};
        case spv::OpVectorInsertDynamic:
            return with_component(values(each.at(2)), value(each.at(3)), value(each.at(4)));
        default: return linear_algebra(each);
        }
    }

    std::pair<size_t, size_t> part_of(Id type_id, std::span<const uint32_t> indices) const {
        size_t first = 0;
        for (const uint32_t index : indices) {
            first += types_.offset(type_id, index);
            type_id = types_.part(type_id, index);
        }
        return {first, type(type_id).count};
    }
    Values extract(Id whole, std::span<const uint32_t> indices) {
        const auto [first, count] = part_of(type_of(whole), indices);
        const Values& all = values(whole);
        if (first + count > all.size())
            cannot("a part that its value does not have");
        return Values(all.begin() + long(first), all.begin() + long(first + count));
    }
    Values insert(const SpirvInstruction& each) {
        Values whole = values(each.at(3));
        const auto [first, count] = part_of(each.at(0), each.from(4));
        const Values& part = values(each.at(2));
        if (first + count > whole.size() || part.size() != count)
            cannot("a part that its value does not have");
        std::copy(part.begin(), part.end(), whole.begin() + long(first));
        return whole;
    }
    Values shuffle(const SpirvInstruction& each) {
        const Id both[] = {each.at(2), each.at(3)};
        const Values all = together(both);
        Values result;
        for (const uint32_t index : each.from(4))
            result.push_back(all[index < all.size() ? index : 0]);
        return result;
    }

    Value is_index(Value index, size_t i) {
        return build_.add(Op::equal, Scalar::boolean,
                          {index, build_.constant(uint32_t(i), build_.type_of(index))});
    }
    Value component(const Values& vector, Value index) {
        Value result = vector.back();
        for (size_t i = vector.size() - 1; i-- > 0;)
            result = build_.add(Op::select, build_.type_of(result), {is_index(index, i), vector[i], result});
        return result;
    }
    Values with_component(const Values& vector, Value what, Value index) {
        Values result;
        for (size_t i = 0; i < vector.size(); ++i)
            result.push_back(
                build_.add(Op::select, build_.type_of(what), {is_index(index, i), what, vector[i]}));
        return result;
    }

    Values linear_algebra(const SpirvInstruction& each) {
        const auto parts = [&](Id id) { return type(type_of(id)).parts; };
        switch (each.op) {
        case spv::OpDot: return {build_.dot(values(each.at(2)), values(each.at(3)))};
        case spv::OpMatrixTimesVector:
            return build_.matrix_times_vector(values(each.at(2)), values(each.at(3)));
        case spv::OpVectorTimesMatrix:
            return build_.vector_times_matrix(values(each.at(2)), values(each.at(3)));
        case spv::OpMatrixTimesMatrix:
            return build_.product(values(each.at(2)), parts(each.at(2)), values(each.at(3)));
        case spv::OpOuterProduct: return build_.outer_product(values(each.at(2)), values(each.at(3)));
        case spv::OpTranspose: {
            const Values& matrix = values(each.at(2));
            return build_.transpose(matrix, uint32_t(matrix.size()) / parts(each.at(2)));
        }
        default: return looked_up(each);
        }
    }

    Values called(const SpirvInstruction& each, Scalar result) {
        const auto function_id = GLSLstd450(each.at(3));
        if (const auto op = proof::componentwise(function_id))
            return componentwise(*op, result, each.from(4));
        const auto a = [&]() -> const Values& { return values(each.at(4)); };
        const auto b = [&]() -> const Values& { return values(each.at(5)); };
        const auto c = [&]() -> const Values& { return values(each.at(6)); };
        switch (function_id) {
        case GLSLstd450Radians: return build_.scaled(a(), build_.constant(0.017453292519943295f));
        case GLSLstd450Degrees: return build_.scaled(a(), build_.constant(57.29577951308232f));
        case GLSLstd450Pow: return power(a(), b());
        case GLSLstd450Length: return {build_.length(a())};
        case GLSLstd450Distance: return {build_.length(build_.difference(a(), b()))};
        case GLSLstd450Normalize: return build_.normalize(a());
        case GLSLstd450Cross: return build_.cross(a(), b());
        case GLSLstd450Reflect: return build_.reflect(a(), b());
        case GLSLstd450Refract: return build_.refract(a(), b(), c()[0]);
        case GLSLstd450FaceForward: return build_.face_forward(a(), b(), c());
        case GLSLstd450FClamp:
        case GLSLstd450SClamp:
        case GLSLstd450UClamp: return build_.clamp(a(), b(), c());
        case GLSLstd450SmoothStep: return build_.smoothstep(a(), b(), c());
        case GLSLstd450Step: {
            const Values below = build_.each(Op::less, Scalar::boolean, {b(), a()});
            return build_.each(Op::select, Scalar::real,
                               {below, {build_.constant(0.0f)}, {build_.constant(1.0f)}});
        }
        case GLSLstd450Fma:
            return build_.each(Op::add, Scalar::real,
                               {build_.each(Op::multiply, Scalar::real, {a(), b()}), c()});
        case GLSLstd450Determinant: return {build_.determinant(a(), type(type_of(each.at(4))).parts)};
        case GLSLstd450MatrixInverse: return build_.inverse(a(), type(type_of(each.at(4))).parts);
        case GLSLstd450Modf: {
            const Values whole = build_.each(Op::truncate, Scalar::real, {a()});
            write(pointer(each.at(5)), whole);
            return build_.difference(a(), whole);
        }
        case GLSLstd450ModfStruct: { // glslang 15 uses this form: a structure of both parts
            const Values whole = build_.each(Op::truncate, Scalar::real, {a()});
            Values parts = build_.difference(a(), whole);
            parts.insert(parts.end(), whole.begin(), whole.end());
            return parts;
        }
        default: cannot(fmt::format("the built-in function number {}", uint32_t(function_id)));
        }
    }

    /// Drivers expand these powers into products of squares, which are defined for negative numbers, too.
    Values power(const Values& base, const Values& exponent) {
        const auto is = [&](float number) {
            return std::ranges::all_of(exponent, [&](Value each) {
                const Instruction& constant = function().instructions[each];
                return constant.op == Op::constant && constant.immediate == std::bit_cast<uint32_t>(number);
            });
        };
        const auto square = [&](const Values& a) { return build_.each(Op::multiply, Scalar::real, {a, a}); };
        if (is(2))
            return square(base);
        if (is(4))
            return square(square(base));
        return build_.each(Op::pow, Scalar::real, {base, exponent});
    }

    // -- Textures

    Values looked_up(const SpirvInstruction& each) {
        Lookup lookup;
        size_t extra = 4; // index of the first image operand
        switch (each.op) {
        case spv::OpImage: same_pointer(each.at(1), each.at(2)); return {};
        case spv::OpImageSampleImplicitLod:
        case spv::OpImageSampleExplicitLod: break;
        case spv::OpImageFetch: lookup.form = Lookup::Form::fetch; break;
        case spv::OpImageQuerySizeLod: lookup.form = Lookup::Form::size; break;
        case spv::OpImageGather:
            lookup.form = Lookup::Form::gather;
            lookup.component = constant_of(each.at(4));
            extra = 5;
            break;
        default: cannot(fmt::format("the instruction number {}", uint32_t(each.op)));
        }
        const Pointer& place = pointer(each.at(2));
        lookup.sampler = place.sampler;
        Values operands = values(each.at(3));
        const uint32_t dimensions = type(place.type).dimensions;
        lookup.coordinates = lookup.form == Lookup::Form::size ? 0 : dimensions;
        operands.resize(std::min<size_t>(operands.size(), std::max(1u, lookup.coordinates)));
        lookup.has_level = lookup.form == Lookup::Form::size;
        add_image_operands(each, extra, lookup, operands);
        return components(each.at(0), lookup, operands);
    }

    void add_image_operands(const SpirvInstruction& each, size_t at, Lookup& lookup, Values& operands) {
        if (at >= each.words.size())
            return;
        const uint32_t mask = each.at(at++);
        const auto take = [&] {
            const Values& part = values(each.at(at++));
            operands.insert(operands.end(), part.begin(), part.end());
        };
        if (mask & spv::ImageOperandsBiasMask) {
            lookup.has_bias = true;
            take();
        }
        if (mask & spv::ImageOperandsLodMask) {
            lookup.has_level = true;
            take();
        }
        if (mask & spv::ImageOperandsGradMask) {
            lookup.has_gradients = true;
            take();
            take();
        }
        if (mask &
            ~uint32_t(spv::ImageOperandsBiasMask | spv::ImageOperandsLodMask | spv::ImageOperandsGradMask))
            cannot("a texture look-up with an offset");
    }

    Values components(Id type_id, Lookup lookup, const Values& operands) {
        Values result;
        const uint32_t first = lookup.component;
        const std::vector<Scalar> kinds = scalars(type_id);
        for (uint32_t i = 0; i < kinds.size(); ++i) {
            lookup.component = first + i;
            function().lookups.push_back(lookup);
            result.push_back(
                build_.add(Op::texel, kinds[i], operands, uint32_t(function().lookups.size() - 1)));
        }
        return result;
    }
};

} // namespace tidemark::proof
