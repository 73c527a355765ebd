#include "render/frame_state.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::render::orbit_camera_test {

OrbitCamera camera(double azimuth, double elevation, double distance, glm::dvec3 target = glm::dvec3(0)) {
    return {azimuth, elevation, distance, target};
}

glm::vec3 column(const OrbitCamera& camera, int index) {
    return glm::vec3(camera.matrix()[index]);
}

void expect_near(glm::dvec3 a, glm::dvec3 b, double tolerance) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

const OrbitCamera k_cameras[] = {
    camera(0, 0, 10),
    camera(30, 20, 10),
    camera(200, -70, 0.001, {1, 2, 3}),
    camera(359, 89.9, 1000000),
    camera(90, -89.9, 5, {0, 7, 0}),
};

TEST(OrbitCamera, at_zero_is_on_z_and_looks_along_minus_z) {
    const OrbitCamera still = camera(0, 0, 10);
    expect_near(column(still, 0), {1, 0, 0}, 0);
    expect_near(column(still, 1), {0, 1, 0}, 0);
    expect_near(column(still, 2), {0, 0, 1}, 0);
    expect_near(column(still, 3), {0, 0, 10}, 0);
    EXPECT_EQ(still.matrix()[3][3], 1);
}

TEST(OrbitCamera, azimuth_rotates_eastward_and_elevation_raises) {
    expect_near(column(camera(90, 0, 10), 3), {10, 0, 0}, 1e-5);
    expect_near(column(camera(180, 0, 10), 3), {0, 0, -10}, 1e-5);
    expect_near(column(camera(0, 30, 10), 3), {0, 5, std::sqrt(75.0)}, 1e-5);
    expect_near(column(camera(0, -30, 10, {1, 1, 1}), 3), {1, -4, std::sqrt(75.0) + 1}, 1e-5);
}

TEST(OrbitCamera, its_axes_are_orthonormal_and_right_handed) {
    for (const OrbitCamera& each : k_cameras) {
        const glm::mat3 axes(each.matrix());
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(glm::dot(axes[i], axes[k]), i == k ? 1 : 0, 1e-6);
        EXPECT_NEAR(glm::determinant(axes), 1, 1e-6);
    }
}

TEST(OrbitCamera, looks_at_its_target_from_its_distance) {
    for (const OrbitCamera& each : k_cameras) {
        const glm::dvec3 position = column(each, 3);
        const glm::dvec3 backwards = column(each, 2);
        expect_near(position - backwards * each.distance, each.target, each.distance * 1e-6 + 1e-6);
    }
}

TEST(OrbitCamera, the_horizon_stays_level) {
    for (const OrbitCamera& each : k_cameras) {
        EXPECT_NEAR(column(each, 0).y, 0, 1e-7);
        EXPECT_GT(column(each, 1).y, 0);
    }
}

TEST(OrbitCamera, a_drag_over_the_window_s_height_is_half_a_circle) {
    OrbitCamera turned = camera(100, 0, 10);
    turned.turn(180, 0, 360);
    EXPECT_DOUBLE_EQ(turned.azimuth, 10);
    turned.turn(0, -90, 360);
    EXPECT_DOUBLE_EQ(turned.elevation, 45);
}

TEST(OrbitCamera, a_drag_to_the_right_moves_the_scene_to_the_right) {
    OrbitCamera turned = camera(0, 0, 10);
    turned.turn(1, 0, 360); // the camera goes west: things nearer than the target move right in its view
    EXPECT_LT(column(turned, 3).x, 0);
    turned = camera(0, 0, 10);
    turned.turn(0, 1, 360); // up: the camera goes down
    EXPECT_LT(column(turned, 3).y, 0);
}

TEST(OrbitCamera, azimuth_wraps) {
    OrbitCamera turned = camera(10, 0, 10);
    turned.turn(20, 0, 180);
    EXPECT_DOUBLE_EQ(turned.azimuth, 350);
    turned.turn(-20, 0, 180);
    EXPECT_DOUBLE_EQ(turned.azimuth, 10);
    turned.turn(-3600, 0, 180);
    EXPECT_DOUBLE_EQ(turned.azimuth, 10);
}

TEST(OrbitCamera, azimuth_never_reaches_360) {
    OrbitCamera turned = camera(0, 0, 10);
    turned.turn(1e-20, 0, 180);
    EXPECT_GE(turned.azimuth, 0);
    EXPECT_LT(turned.azimuth, 360);
    EXPECT_LT(parse_camera("-1e-20,0,1")->azimuth, 360);
    EXPECT_EQ(parse_camera("360,0,1")->azimuth, 0);
    EXPECT_EQ(parse_camera("-30,0,1")->azimuth, 330);
}

TEST(OrbitCamera, the_poles_are_not_reached) {
    OrbitCamera turned = camera(0, 0, 10);
    turned.turn(0, -100000, 360);
    EXPECT_EQ(turned.elevation, 89.9);
    turned.turn(0, 100000, 360);
    EXPECT_EQ(turned.elevation, -89.9);
}

TEST(OrbitCamera, a_wheel_step_moves_a_tenth_nearer_and_back) {
    OrbitCamera zoomed = camera(0, 0, 10);
    zoomed.zoom(1);
    EXPECT_DOUBLE_EQ(zoomed.distance, 9);
    zoomed.zoom(-1);
    EXPECT_DOUBLE_EQ(zoomed.distance, 10);
    zoomed.zoom(0.5);
    zoomed.zoom(0.5);
    EXPECT_DOUBLE_EQ(zoomed.distance, 9);
}

TEST(OrbitCamera, the_distance_has_bounds) {
    OrbitCamera zoomed = camera(0, 0, 10);
    zoomed.zoom(1e9);
    EXPECT_EQ(zoomed.distance, 1e-3);
    zoomed.zoom(-1e9);
    EXPECT_EQ(zoomed.distance, 1e6);
}

/// Returns a point's offset from the middle of the picture in pixels, for a ray that goes through
/// (offset / height, -1), as ShaderToy's scenes make it.
glm::dvec2 seen_at(const OrbitCamera& camera, glm::dvec3 point, double height) {
    const glm::dvec4 local = glm::inverse(glm::dmat4(camera.matrix())) * glm::dvec4(point, 1);
    return glm::dvec2(local) / -local.z * height;
}

TEST(OrbitCamera, a_pan_keeps_the_point_under_the_pointer) {
    for (OrbitCamera each : {camera(0, 0, 10), camera(30, 20, 10), camera(200, -70, 3, {1, 2, 3})}) {
        const glm::dvec3 point = each.target; // is seen in the middle
        each.pan(40, -25, 360);
        const glm::dvec2 seen = seen_at(each, point, 360);
        EXPECT_NEAR(seen.x, 40, 1e-3);
        EXPECT_NEAR(seen.y, -25, 1e-3);
    }
}

TEST(OrbitCamera, a_pan_keeps_the_orientation) {
    OrbitCamera panned = camera(30, 20, 10);
    const glm::mat3 axes(panned.matrix());
    panned.pan(40, -25, 360);
    EXPECT_EQ(glm::mat3(panned.matrix()), axes);
    EXPECT_EQ(panned.distance, 10);
}

TEST(ParseCamera, azimuth_elevation_distance) {
    const auto parsed = parse_camera("45.5,-20,1e2");
    ASSERT_TRUE(parsed);
    EXPECT_EQ(parsed->azimuth, 45.5);
    EXPECT_EQ(parsed->elevation, -20);
    EXPECT_EQ(parsed->distance, 100);
    EXPECT_EQ(parsed->target, glm::dvec3(0));
    EXPECT_EQ(parse_camera("45.5,-20,1e2,1,-2.5,3")->target, glm::dvec3(1, -2.5, 3));
    EXPECT_EQ(parse_camera("0,90,1")->elevation, 89.9);
    EXPECT_EQ(parse_camera("0,-90,1")->elevation, -89.9);
}

TEST(OrbitMotion, is_exactly_zero_at_the_start) {
    const OrbitMotion motion = motion_of(OrbitCamera{});
    EXPECT_EQ(motion.turn, glm::dvec2(0));
    EXPECT_EQ(motion.distance, 1);
    EXPECT_EQ(motion.pan, glm::dvec3(0));
}

TEST(OrbitMotion, rotates_by_the_shorter_angle) {
    EXPECT_NEAR(motion_of(camera(350, 20, 10)).turn.x, glm::radians(-40.0), 1e-12);
    EXPECT_NEAR(motion_of(camera(200, 65, 10)).turn.x, glm::radians(170.0), 1e-12);
    EXPECT_NEAR(motion_of(camera(200, 65, 10)).turn.y, glm::radians(45.0), 1e-12);
    EXPECT_EQ(motion_of(camera(30, 20, 25)).distance, 2.5);
}

TEST(OrbitMotion, pans_along_the_first_heading) {
    OrbitCamera moved;
    moved.elevation = 0; // the picture is 1 high at distance 1: a drag across its height pans by the distance
    moved.pan(-100, 0, 100);
    expect_near(motion_of(moved).pan, {1, 0, 0}, 1e-12);
    moved.pan(0, -50, 100);
    expect_near(motion_of(moved).pan, {1, 0.5, 0}, 1e-12);
    expect_near(motion_of(camera(30, 20, 10, glm::dvec3(column(camera(30, 0, 10), 2)) * 20.0)).pan, {0, 0, 2},
                1e-6);
}

TEST(ParseCamera, invalid_cameras) {
    for (const std::string text :
         {"",        "1",         "1,2",           "1,2,",          "1,2,3,",
          "1,2,3,4", "1,2,x",     "x,2,3",         " 1,2,3",        "1, 2,3",
          "1,2,3 ",  "nan,0,1",   "0,inf,1",       "0,0,nan",       "0,0,0",
          "0,0,-1",  "0,0,1e7",   "0,0,1e-4",      "1e999,0,1",     ",,",
          "1;2;3",   "1,2,3,4,5", "1,2,3,4,5,nan", "1,2,3,4,5,6,7", "1,2,3,4,5,6;"}) {
        const auto parsed = parse_camera(text);
        ASSERT_FALSE(parsed) << text;
        EXPECT_EQ(parsed.error().code, ErrorCode::usage);
        EXPECT_EQ(parsed.error().message,
                  "--camera " + text +
                      ": give azimuth,elevation,distance as in 30,20,10 (degrees, degrees, a distance above "
                      "0), and after them x,y,z if the view was panned");
    }
}

TEST(ParseCamera, its_numbers_are_floats) {
    for (const std::string text : {"1e39,0,1", "0,0,1,1e39,0,0", "0,0,1,0,0,-1e39"})
        EXPECT_FALSE(parse_camera(text)) << text;
    EXPECT_TRUE(std::isfinite(column(*parse_camera("0,0,1e6,0,0,3.4028234e38"), 3).z));
}

} // namespace tidemark::render::orbit_camera_test
