#include "gl/elapsed_time.hpp"

namespace tidemark::gl {
namespace {

QueryHandle create_query() {
    GLuint id = 0;
    glCreateQueries(GL_TIME_ELAPSED, 1, &id);
    return QueryHandle(id);
}

} // namespace

ElapsedTime::ElapsedTime() : query_(create_query()) {
    glBeginQuery(GL_TIME_ELAPSED, query_.id());
}

void ElapsedTime::stop() {
    glEndQuery(GL_TIME_ELAPSED);
}

std::optional<double> ElapsedTime::milliseconds() const {
    GLint bits = 0;
    glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0)
        return std::nullopt;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &nanoseconds);
    return double(nanoseconds) * 1e-6;
}

} // namespace tidemark::gl
