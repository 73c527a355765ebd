#include "lab/nan_trace.hpp"

#include "base/error.hpp"
#include "media/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tidemark::lab {
namespace {

using glsl::k_no_node;
using glsl::NodeId;
using glsl::WatchRequest;
using Reach = WatchRequest::Reach;

/// Most operations to fix in one pixel; of 70 shaders all were fixed in five steps.
constexpr size_t k_most_repairs = 6;

/// Compares two pixels except for rounding, which differs if the driver optimises the instrumented text
/// otherwise.
bool same(const PixelBits& a, const PixelBits& b) {
    for (size_t i = 0; i < a.size(); ++i) {
        const auto x = std::bit_cast<float>(a[i]);
        const auto y = std::bit_cast<float>(b[i]);
        if (std::isnan(x) != std::isnan(y) || std::isinf(x) != std::isinf(y) ||
            std::abs(x - y) > 1e-3f * std::max(1.0f, std::abs(x)))
            return false;
    }
    return true;
}

std::string to_text(const PixelBits& bits) {
    ShaderValue value{{'f', 1, 4}, {}};
    std::copy(bits.begin(), bits.end(), value.bits.begin());
    return to_string(value);
}

/// Traces one pixel of one pass at one moment.
class PixelTracer {
public:
    PixelTracer(const PassPreview& preview, const WatchedText& watched, NanTrace& trace,
                const TraceRequest& request)
        : preview_(preview), watched_(watched), trace_(trace), request_(request) {}

    Result<void> run(bool nan_only) {
        nan_only_ = nan_only;
        auto reading = TRY(locate());
        compare(reading);
        if (reading.hit() == k_no_node) {
            return {};
        }
        return follow(reading.hit());
    }

private:
    WatchRequest watch_request(Reach reach) const {
        WatchRequest request;
        request.reach = reach;
        request.repaired = repaired_;
        request.nan_only = nan_only_;
        return request;
    }

    Result<WatchReading> read(const WatchRequest& request) const {
        return read_pixel(preview_, glsl::watch(watched_.text, watched_.facts, request), trace_.pixel);
    }

    /// Finds the first statement that is not finite, or, if there is none, the first operation at all.
    Result<WatchReading> locate() {
        if (!everything_) {
            auto reading = read(watch_request(Reach::statements));
            const bool enough =
                !reading || reading->hit() != k_no_node || (is_finite(reading->colour) && !trace_.masked);
            if (enough)
                return reading;
        }
        everything_ = true;
        return read(watch_request(Reach::everything));
    }

    void compare(const WatchReading& reading) {
        if (!reading.arrived())
            trace_.notes.emplace_back("the instrumented shader did not finish in this pixel");
        const bool half = preview_.pass().kind == scene::PassKind::cubemap;
        if (is_finite(reading.colour) != is_finite(trace_.colour) ||
            (!half && !same(reading.colour, trace_.colour)))
            trace_.notes.push_back(fmt::format(
                "the instrumented shader gives this pixel another value: {} as drawn, {} instrumented",
                to_text(trace_.colour), to_text(reading.colour)));
    }

    /// Returns the operation in the statement that is not finite.
    Result<NodeId> narrow(NodeId statement) const {
        if (everything_)
            return statement;
        WatchRequest inside = watch_request(Reach::operations);
        inside.within = statement;
        const auto reading = TRY(read(inside));
        return reading.hit() != k_no_node ? reading.hit() : statement;
    }

    Result<NanOrigin> captured(NodeId statement, NodeId operation) const {
        NanOrigin origin = describe(watched_, operation);
        WatchRequest request = watch_request(Reach::operations);
        request.within = statement;
        request.capture = operation;
        const glsl::Watch watch = glsl::watch(watched_.text, watched_.facts, request);
        auto reading = TRY(read_pixel(preview_, watch, trace_.pixel));
        if (reading.hit() == operation)
            add_reading(origin, watched_, operation, watch, reading, preview_.scene(), preview_.pass());
        return origin;
    }

    void report() const {
        if (request_.progress)
            request_.progress(trace_);
    }

    /// Records the first origin, then fixes one operation after the other until the pixel is finite.
    Result<void> follow(NodeId statement) {
        trace_.first = describe(watched_, statement);
        report();
        NodeId operation = k_no_node;
        for (;;) {
            operation = TRY(narrow(statement));
            if (repaired_.empty()) {
                auto origin = TRY(captured(everything_ ? operation : statement, operation));
                trace_.first = std::move(origin);
                report();
                if (trace_.masked)
                    return {};
            }
            repaired_.push_back(operation);
            auto reading = TRY(locate());
            if (is_finite(reading.colour))
                return fixed(statement, operation);
            if (reading.hit() == k_no_node || repaired_.size() == k_most_repairs)
                break;
            statement = reading.hit();
        }
        trace_.notes.push_back(fmt::format("fixing {} operations does not fix the pixel", repaired_.size()));
        return {};
    }

    Result<void> fixed(NodeId statement, NodeId operation) {
        trace_.fix_is_first = repaired_.size() == 1;
        if (trace_.fix_is_first) {
            trace_.fix = trace_.first;
            return {};
        }
        repaired_.pop_back();
        trace_.fix = TRY(captured(everything_ ? operation : statement, operation));
        return {};
    }

    const PassPreview& preview_;
    const WatchedText& watched_;
    NanTrace& trace_;
    const TraceRequest& request_;
    std::vector<NodeId> repaired_;
    bool nan_only_ = false;
    bool everything_ = false;
};

/// A pixel that is not finite, with its pass and frame.
struct BadPixel {
    size_t pass = 0;
    int frame = 0;
    PixelPlace pixel{};
};

std::optional<PixelPlace> first_bad(const render::Renderer& renderer, size_t pass) {
    const bool cube = renderer.scene().passes[pass].kind == scene::PassKind::cubemap;
    for (int face = 0; face < (cube ? 6 : 1); ++face)
        if (const auto first = image::census(renderer.read_floats(pass, face)).first_non_finite)
            return PixelPlace{first->x, first->y, face};
    return std::nullopt;
}

class Tracer {
public:
    Tracer(render::Renderer& renderer, const TraceRequest& request)
        : renderer_(renderer), request_(request), stepper_(renderer, request.states, request.start) {}

    Result<std::optional<NanTrace>> run() {
        if (request_.pixel)
            return trace({renderer_.shown_index(), request_.frame, *request_.pixel}, false);
        if (const auto bad = scan())
            return trace(*bad, false);
        if (request_.hidden)
            return hidden();
        return std::optional<NanTrace>();
    }

private:
    render::FrameStepper::MayDraw tell_of_steps() const {
        return [this](int frame, int) {
            if (request_.stepping)
                request_.stepping(frame);
            return true;
        };
    }

    /// Finds the earliest frame and pass with a bad pixel; later ones may only have inherited it.
    std::optional<BadPixel> scan() {
        for (int frame = renderer_.plan().feedback ? request_.start : request_.frame;; ++frame) {
            stepper_.draw(frame, tell_of_steps());
            for (const render::PlannedPass& planned : renderer_.plan().passes)
                if (const auto pixel = first_bad(renderer_, planned.pass))
                    return BadPixel{planned.pass, frame, *pixel};
            if (frame >= request_.frame) // checked last, as it may be the largest int
                return std::nullopt;
        }
    }

    Result<std::optional<NanTrace>> trace(const BadPixel& bad, bool nan_only) {
        NanTrace trace;
        trace.pass = renderer_.scene().passes[bad.pass].name;
        trace.frame = bad.frame;
        trace.pixel = bad.pixel;
        stepper_.draw(bad.frame, tell_of_steps());
        trace.colour = bits_at(renderer_.read_floats(bad.pass, bad.pixel.face), bad.pixel);
        trace.masked = is_finite(trace.colour);
        if (request_.progress && !trace.masked)
            request_.progress(trace);
        const PassPreview preview = stepper_.preview(bad.frame, bad.pass, tell_of_steps());
        auto text = TRY(read_text(renderer_, bad.pass));
        const glsl::TreeFacts facts = glsl::find_facts(*text);
        const WatchedText watched{*text, facts};
        if (auto done = PixelTracer(preview, watched, trace, request_).run(nan_only); !done)
            trace.notes.push_back(to_string(done.error()));
        if (trace.masked && !trace.first)
            return std::optional<NanTrace>();
        return std::optional(std::move(trace));
    }

    /// Looks for a NaN that something masked, if no pixel is bad. Infinities alone are often intended.
    Result<std::optional<NanTrace>> hidden() {
        for (const render::PlannedPass& planned : renderer_.plan().passes) {
            if (renderer_.scene().passes[planned.pass].kind == scene::PassKind::cubemap)
                continue;
            const auto pixel = TRY(first_hidden(planned.pass));
            if (pixel)
                return trace({planned.pass, request_.frame, *pixel}, true);
        }
        return std::optional<NanTrace>();
    }

    /// Returns the first pixel of the pass in which an operation gives NaN.
    Result<std::optional<PixelPlace>> first_hidden(size_t pass) {
        const PassPreview preview = stepper_.preview(request_.frame, pass, tell_of_steps());
        auto text = TRY(read_text(renderer_, pass));
        WatchRequest watch_request;
        watch_request.reach = Reach::everything;
        watch_request.nan_only = true;
        watch_request.map_width = preview.extent().width;
        const auto hits =
            TRY(read_map(preview, glsl::watch(*text, glsl::find_facts(*text), watch_request), 0));
        const auto hit = std::find_if(hits.begin(), hits.end(), [](NodeId id) { return id != 0; });
        if (hit == hits.end())
            return std::optional<PixelPlace>();
        const int index = int(hit - hits.begin());
        const int width = watch_request.map_width;
        return PixelPlace{index % width, index / width, 0};
    }

    render::Renderer& renderer_;
    const TraceRequest& request_;
    render::FrameStepper stepper_;
};

} // namespace

Result<std::optional<NanTrace>> trace_nan(render::Renderer& renderer, const TraceRequest& request) {
    return Tracer(renderer, request).run();
}

} // namespace tidemark::lab
