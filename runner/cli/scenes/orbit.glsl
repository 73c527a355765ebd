// A ball on a chequered floor, seen by the host's camera: drag to turn it, the wheel goes nearer, the middle button
// pans, R begins anew. `--camera 30,20,6` is the same on the command line: azimuth, elevation, distance.
//
// Lengths are in radii of the ball, which lies around (0, 0, 0); y is up.

// Tidemark fills this where a text declares it. Columns: right, up, backwards, position.
uniform mat4 iCamera;

#iUniform float focal_length = 2.5 in { 0.5, 4.0 }
#iUniform vec2 sun_place = vec2(-0.9, 0.6) in { -3.1416, 3.1416 }
#iUniform color3 ball_color = color3(0.7, 0.1, 0.05)

const vec3 k_sky = vec3(0.3, 0.48, 0.7);
const vec3 k_sunlight = vec3(1.1, 1.0, 0.85);
const float k_floor = -1.0;

struct Ray {
    vec3 origin;
    vec3 direction; // unit
};

// The ray through a pixel. The picture is 1 high at the distance `focal_length`.
Ray ray_through(vec2 pixel) {
    vec2 at = (pixel - 0.5 * iResolution.xy) / iResolution.y;
    return Ray(iCamera[3].xyz, mat3(iCamera) * normalize(vec3(at, -focal_length)));
}

// To the sun: yaw (0: +z) and height above the horizon, radians.
vec3 to_sun() {
    return vec3(sin(sun_place.x) * cos(sun_place.y), sin(sun_place.y), cos(sun_place.x) * cos(sun_place.y));
}

// Distance to the ball, -1: none. |origin + t direction|^2 = 1 in t; both roots are behind a ray that looks away.
float hit_ball(Ray ray) {
    float along = dot(ray.origin, ray.direction);
    vec3 nearest = ray.origin - along * ray.direction;
    float inside = 1.0 - dot(nearest, nearest); // without the cancellation of along^2 - |origin|^2
    if (inside < 0.0) {
        return -1.0;
    }
    float root = sqrt(inside);
    float entry = -along - root;
    return entry > 0.0 ? entry : root - along > 0.0 ? root - along : -1.0;
}

// Distance to the floor, -1: none. From below it, too.
float hit_floor(Ray ray) {
    float fall = k_floor - ray.origin.y;
    return fall * ray.direction.y > 0.0 ? fall / ray.direction.y : -1.0;
}

// The mean of a square wave (-1, 1, period 2) over `width` around x: the difference of its integral, a triangle wave.
float mean_of_squares(float x, float width) {
    vec2 ends = fract(0.5 * (x + vec2(-0.5, 0.5) * width));
    vec2 integral = 2.0 * abs(ends - 0.5);
    return (integral.x - integral.y) / width;
}

// The floor's colour at a place, over the size that a pixel has there: far away it is an even grey.
vec3 floor_color(vec2 place, float size) {
    float width = clamp(size, 1e-3, 8.0);
    float chequer = mean_of_squares(place.x, width) * mean_of_squares(place.y, width);
    return vec3(0.4 + 0.25 * chequer);
}

vec3 shade_ball(Ray ray, float t) {
    vec3 normal = normalize(ray.origin + t * ray.direction);
    float lit = max(dot(normal, to_sun()), 0.0);
    vec3 ambient = k_sky * (0.6 + 0.4 * normal.y);
    float glint = pow(max(dot(reflect(ray.direction, normal), to_sun()), 0.0), 60.0);
    return ball_color * (ambient + lit * k_sunlight) + 0.4 * glint * k_sunlight;
}

vec3 shade_floor(Ray ray, float t) {
    vec3 position = ray.origin + t * ray.direction;
    float shadow = hit_ball(Ray(position, to_sun())) < 0.0 ? 1.0 : 0.0;
    // The part of the sky that the ball hides from here: the form factor of a sphere that rests on a plane.
    float distance = length(position);
    float hidden = 1.0 / (distance * distance * distance);
    float pixel = t / (iResolution.y * focal_length * max(abs(ray.direction.y), 1e-3));
    vec3 light = (1.0 - hidden) * k_sky + shadow * max(to_sun().y, 0.0) * k_sunlight;
    return floor_color(position.xz, pixel) * light;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    Ray ray = ray_through(fragCoord);
    float ball = hit_ball(ray);
    float ground = hit_floor(ray);
    vec3 color = k_sky;
    if (ball > 0.0 && (ground < 0.0 || ball < ground)) {
        color = shade_ball(ray, ball);
    } else if (ground > 0.0) {
        color = mix(k_sky, shade_floor(ray, ground), exp(-0.02 * ground)); // haze
    }
    fragColor = vec4(pow(clamp(color, 0.0, 1.0), vec3(1.0 / 2.2)), 1.0);
}
