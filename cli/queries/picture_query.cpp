#include "cli/queries/picture_query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/options/picture_options.hpp"
#include "cli/queries/surface_query.hpp"
#include "core/error.hpp"
#include "core/rough/ggx.hpp"
#include "schemas/documents/lamp_document.hpp"
#include "schemas/input_error.hpp"
#include "schemas/readers/text_file.hpp"
#include "tables/files/hash.hpp"
#include "tables/pictures/rendered.hpp"

namespace irido::cli {

namespace {

constexpr std::size_t kRoughSamples = 64;
constexpr double kMostSide = 8192, kMostSeed = 1e15;

/// Parses W,H or one number for both.
std::array<std::size_t, 2> parse_picture_size(const std::string& text) {
    const std::vector<std::string_view> parts = comma_separated(text);
    if (parts.size() > 2) throw UsageError("--size: must be W,H (got '" + text + "')");
    std::array<std::size_t, 2> size{};
    for (std::size_t i = 0; i < 2; ++i)
        size[i] = parse_whole_number("--size", parts[std::min(i, parts.size() - 1)], 1, kMostSide);
    return size;
}

/// Parses LO:HI,SCALE,SEED; scale and seed may be omitted.
ThicknessNoise parse_noise(const std::string& text, const std::string& octaves) {
    constexpr const char* kOption = "--thickness-noise";
    const std::vector<std::string_view> parts = comma_separated(text);
    if (parts.size() > 3)
        throw UsageError(std::string(kOption) + ": must be LO:HI,SCALE,SEED (got '" + text + "')");
    ThicknessNoise noise;
    std::tie(noise.least_nm, noise.most_nm) =
        parse_range(kOption, parts[0], 0, kLargestThickness_nm);
    noise.scale = parts.size() < 2
                      ? 3
                      : parse_one_number(kOption, parts[1], 0, ThicknessNoise::kLargestScale);
    if (parts.size() == 3) noise.seed = parse_whole_number(kOption, parts[2], 0, kMostSeed);
    noise.octaves = static_cast<unsigned>(
        parse_whole_number("--octaves", octaves, 1, ThicknessNoise::kMostOctaves));
    return noise;
}

Triple parse_background(const std::string& text) {
    try {
        return rgb_of_hex(rgb_space("srgb"), text);
    } catch (const DomainError&) {
        constexpr std::array<std::string_view, 3> names{"none", "environment", "#rrggbb"};
        throw UsageError("--background: " + not_one_of(names, text));
    }
}

bool is_exr(const std::string& text) {
    return text.ends_with(".exr");
}

Environment parse_environment(const std::string& text, std::string& hash) {
    if (!is_exr(text)) {
        std::vector<std::string_view> names(environment_names().begin(), environment_names().end());
        if (std::ranges::find(names, text) != names.end()) return named_environment(text);
        names.emplace_back("an .exr file");
        throw UsageError("--environment: " + not_one_of(names, text));
    }
    const std::string bytes = schemas::read_bytes(text, schemas::TextSource::regular_file);
    hash = tables::sha256_of(bytes);
    try {
        return image_environment(
            std::make_shared<EnvironmentImage>(tables::environment_from_exr(bytes)));
    } catch (const schemas::InputError&) {
        throw;
    } catch (const Error& error) {
        throw schemas::InputError(text, "", error.what());
    }
}

/// Index of the substrate relative to the incident medium, mid-spectrum. Throws DomainError.
double index_of_gem(const Stack& stack) {
    constexpr double kMiddle_nm = 550;
    const IndexTable indices(stack, {kMiddle_nm});
    const Complex inside = indices.index(stack.substrate, 0);
    if (std::abs(inside.imag()) >= kTransparentBelow_k)
        throw DomainError("a gem must be transparent, |k| of the substrate below 1e-3 (got " +
                          to_text(inside.imag()) + " at 550 nm)");
    return inside.real() / indices.n(stack.incident, 0);
}

std::string rounded_text(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

}  // namespace

void PictureQueryOptions::add(CLI::App& command) {
    const auto option = [&](const char* name, std::string& value, const char* help,
                            const char* type) {
        command.add_option(name, value, help)->type_name(type);
    };
    option("--size", size, "width and height in pixels, [1, 8192] [512,512; 192,192 with --vary]",
           "W,H");
    option("--shape", shape,
           "sphere, bubble (both walls; the same medium inside and outside), plane,\n"
           "ring, or gem (light is refracted into the substrate) [sphere]",
           "NAME");
    option("--tilt", tilt, "angle between a plane's normal and the line of sight, degrees [0]",
           "ANGLE");
    option("--environment", environment,
           "light from all around: studio, sky, white (radiance 1), none, or a\n"
           "latitude-longitude picture .exr, twice as wide as high, in linear\n"
           "sRGB; its channels multiply those of the colours [studio]",
           "NAME");
    option("--camera", camera, "orthographic or perspective [orthographic]", "NAME");
    option("--background", background,
           "none (transparent), environment, or a colour #rrggbb [none]", "NAME");
    option("--thickness-noise", thickness_noise,
           "let a layer's thickness vary from LO to HI nm by Perlin noise of this scale\n"
           "[3] and seed [0], as irido lut thickness has it",
           "LO:HI,SCALE,SEED");
    option("--octaves", octaves, "octaves of the noise, [1, 16] [1]", "N");
    option("--noise-layer", noise_layer,
           "the layer whose thickness varies, counted from 1 as light meets them;\n"
           "the layers of a group count once [1]",
           "N");
    option("--alpha", alpha,
           "roughness of a sphere, a plane or a ring: facets of the GGX distribution,\n"
           "each the stack, [1e-4, 1] [smooth]",
           "ALPHA");
    command
        .add_option("--light", lamps,
                    "a lamp, as JSON or a file of it; repeatable:\n"
                    "{\"direction\": [x, y, z], \"irradiance\": 1, \"angle_deg\": 0.53}\n"
                    "{\"center\": [x, y, z], \"radius\": r, \"radiance\": 10}\n"
                    "{\"vertices\": [[x, y, z], ...], \"radiance\": 10}, or an array of them;\n"
                    "\"illuminant\": \"A\" gives it one of its own. The sphere has the radius 1;\n"
                    "x points right, y up, z towards the viewer; radiance 1 is that of a white\n"
                    "diffuser in the environment white. Lamps are seen in mirrors alone")
        ->type_name("LIGHT")
        ->allow_extra_args(false);
    option("--floor", floor,
           "a white, grey or coloured diffuser to stand on, looked at from above: its\n"
           "albedo, [0, 1], or #rrggbb [none]",
           "ALBEDO");
    option("--paths", paths,
           "of surface documents: single or all, as of irido brdf, where all have a closed\n"
           "form [single]",
           "PATHS");
    option("--transmission", transmission, "single or multiple, as of irido brdf [single]",
           "CROSSINGS");
    option("--samples", samples,
           "rays per pixel, spread over it, [1, 65536] [one, through its centre; 64\n"
           "where light is scattered]",
           "N");
    option("--seed", seed, "of the rays' places in a pixel, and of facets [1]", "N");
    option("--exposure", exposure, "brighten by 2^EV, [-40, 40] [0]", "EV");
    option("--tolerance", tolerance,
           "largest error of colours by a table, CIEDE2000, [0.001, 10] [0.1]", "E");
    command.add_flag("--exact", exact, "compute each pixel's colour, no table");
    add_light_options(command, light);
    add_strict_option(command, light.strict);
    offer(command, "shape", "sphere bubble plane ring gem");
    offer(command, "camera", "orthographic perspective");
    offer(command, "background", "none environment");
    offer(command, "environment", "studio sky white none", OfferedWords::Use::one_or_file);
    offer(command, "paths", "single all");
    offer(command, "transmission", "single multiple");
}

PictureQuery::PictureQuery(const PictureQueryOptions& typed, const Execution& execution,
                           std::size_t usual_size)
    : typed_(typed), execution_(execution) {
    const auto [width, height] =
        typed.size.empty() ? std::array{usual_size, usual_size} : parse_picture_size(typed.size);
    constexpr std::array<std::string_view, 2> cameras{"orthographic", "perspective"};
    if (std::ranges::find(cameras, typed.camera) == cameras.end())
        throw UsageError("--camera: " + not_one_of(cameras, typed.camera));
    scene_.camera = {width, height, typed.camera == "perspective"};
    const auto names = shape_names();
    if (std::ranges::find(names, typed.shape) == names.end())
        throw UsageError("--shape: " + not_one_of(names, typed.shape));
    scene_.shape = shape_kind(typed.shape);
    constexpr double kMostTilt_deg = 89.9;
    scene_.tilt_deg = parse_one_number("--tilt", typed.tilt, -kMostTilt_deg, kMostTilt_deg);
    if (!typed.thickness_noise.empty())
        scene_.noise = parse_noise(typed.thickness_noise, typed.octaves);
    noise_layer_ = parse_whole_number("--noise-layer", typed.noise_layer, 1, 1e9);
    if (!typed.samples.empty())
        scene_.samples = parse_whole_number("--samples", typed.samples, 1,
                                            static_cast<double>(kMostPictureSamples));
    if (!typed.alpha.empty())
        scene_.alpha = parse_one_number("--alpha", typed.alpha, kSmoothest, kRoughest);
    if (scene_.alpha && !is_opaque(scene_.shape))
        throw UsageError("--alpha: a rough " + typed.shape +
                         " cannot be drawn: what its walls let through is not known in all "
                         "directions");
    scene_.seed = parse_whole_number("--seed", typed.seed, 0, kMostSeed);
    exposure_ = parse_one_number("--exposure", typed.exposure, -kMostExposure, kMostExposure);
    tolerance_ = parse_one_number("--tolerance", typed.tolerance, 0.001, 10);
    scene_.environment = parse_environment(typed.environment, environment_hash_);
    if (typed.background == "environment")
        scene_.background = scene_.environment;
    else if (typed.background != "none")
        scene_.background = parse_background(typed.background);
    paths_ = parse_closed_paths(typed.paths);
    crossings_ = parse_crossings(typed.transmission);
    light_ = std::make_unique<Illumination>(
        typed.light.illuminant,
        Sensitivity(parse_observer(typed.light.observer), parse_illuminant(typed.light.illuminant)),
        rgb_space("srgb"), Adaptation::bradford);
    set_lights(typed);
    require_seen_lamps(typed.shape);
}

/// Throws UsageError for a lamp all of whose light is kept by an opaque shape or by the floor.
void PictureQuery::require_seen_lamps(const std::string& shape) const {
    const auto body = make_shape(scene_.shape, scene_.tilt_deg, scene_.camera.elevation_deg);
    const bool is_plane = scene_.shape == ShapeKind::plane;
    for (std::size_t i = 0; i < scene_.lamps.size(); ++i) {
        const Lamp& lamp = scene_.lamps[i].lamp;
        const auto refuse = [&](const std::string& where) {
            throw UsageError("--light: lamp " + std::to_string(i + 1) + " lies " + where +
                             ", which lets no light out");
        };
        if (is_opaque(scene_.shape) &&
            lamp.is_within([&](const Vector3& point) { return body->depth(point); }))
            refuse((is_plane ? "behind the " : "inside the ") + shape);
        if (scene_.floor &&
            lamp.is_within([&](const Vector3& point) { return body->lowest() - point.y; }))
            refuse("below the floor");
    }
}

/// Lamps and the floor.
void PictureQuery::set_lights(const PictureQueryOptions& typed) {
    std::vector<std::string> names{typed.light.illuminant};
    lamp_request_ = nlohmann::json::array();
    for (const std::string& text : typed.lamps)
        for (schemas::LampDocument& lamp : schemas::read_lamps(text)) {
            std::size_t number = 0;
            if (!lamp.illuminant.empty()) {
                number = static_cast<std::size_t>(std::ranges::find(names, lamp.illuminant) -
                                                  names.begin());
                if (number == names.size()) {
                    names.push_back(lamp.illuminant);
                    lamp_lights_.push_back(std::make_unique<Sensitivity>(
                        parse_observer(typed.light.observer), parse_illuminant(lamp.illuminant)));
                }
            }
            lamp_request_.push_back(std::move(lamp.document));
            scene_.lamps.push_back({std::move(lamp.lamp), number});
        }
    if (typed.environment == "none" && scene_.lamps.empty())
        throw UsageError("--environment none: requires a --light, else nothing is seen");
    if (typed.floor.empty()) return;
    if (scene_.shape == ShapeKind::plane)
        throw UsageError("--floor: a plane fills the picture and stands on no floor");
    if (typed.floor.starts_with('#')) {
        try {
            scene_.floor = rgb_of_hex(rgb_space("srgb"), typed.floor);
        } catch (const DomainError&) {
            throw UsageError("--floor: must be an albedo or #rrggbb (got '" + typed.floor + "')");
        }
    } else {
        const double albedo = parse_one_number("--floor", typed.floor, 0, 1);
        scene_.floor = Triple{albedo, albedo, albedo};
    }
    scene_.camera.elevation_deg = usual_elevation_deg(scene_.shape);
}

TracedRequest PictureQuery::traced(const std::function<void(double)>& progress) const {
    if (typed_.exact)
        throw DomainError(
            "--exact: light that is scattered, lamps and floors are computed by tables; "
            "--tolerance sets their error");
    TracedRequest request{.light = light_.get(),
                          .others = {},
                          .paths = paths_,
                          .crossings = crossings_,
                          .tolerance = tolerance_,
                          .execution = execution_,
                          .progress = progress};
    for (const auto& other : lamp_lights_) request.others.push_back(other.get());
    return request;
}

void PictureQuery::expose(Picture& picture) const {
    const auto gain = static_cast<float>(std::exp2(exposure_));
    if (gain == 1) return;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
        if (i % 4 != 3) picture.rgba[i] *= gain;
}

DrawnPicture PictureQuery::draw(const schemas::SurfaceDocument& document,
                                const std::function<void(double)>& progress) const {
    if (scene_.alpha) throw UsageError("--alpha: a surface document has its own roughness");
    try {
        // facets over a black base are those of a stack with a roughness
        if (const auto* const layered = std::get_if<LayeredSurface>(&document.surface)) {
            const bool is_stack = layered->layers.size() == 1 && !layered->is_coated() &&
                                  (!layered->layers[0].is_passable ||
                                   layered->base_albedo == Dispersion{Constant{0}});
            if (is_stack)
                return draw_stack(layered->layers[0].stack, progress, layered->layers[0].alpha);
        }
        if (scene_.noise)
            throw DomainError(
                "--thickness-noise: takes a stack, or a surface of one layer over a black base");
        PictureScene scene = scene_;
        if (typed_.samples.empty()) scene.samples = kRoughSamples;
        DrawnPicture drawn = trace_surface(scene, document.surface, traced(progress));
        expose(drawn.picture);
        return drawn;
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

DrawnPicture PictureQuery::draw(const schemas::StackDocument& document,
                                const std::function<void(double)>& progress,
                                std::optional<double> alpha) const {
    try {
        return draw_stack(document.stack, progress, alpha ? alpha : scene_.alpha);
    } catch (const DomainError& error) {
        throw schemas::InputError(document.file, "", error.what());
    }
}

DrawnPicture PictureQuery::draw_stack(const Stack& stack,
                                      const std::function<void(double)>& progress,
                                      std::optional<double> alpha) const {
    if (scene_.shape == ShapeKind::bubble && stack.incident != stack.substrate)
        throw DomainError("a bubble has the same medium inside as outside (the stack has " +
                          stack.materials[stack.substrate].name + " and " +
                          stack.materials[stack.incident].name + ")");
    SurfaceStack surface{stack};
    PictureScene scene = scene_;
    scene.alpha = alpha;
    if (alpha && typed_.samples.empty()) scene.samples = kRoughSamples;
    if (scene.shape == ShapeKind::gem) scene.inner_index = index_of_gem(stack);
    if (scene.noise) {
        surface.varied = layer_number(stack, noise_layer_);
        scene.thickness_nm = thickness_at(stack, surface.varied);
    }
    const bool is_traced =
        scene.floor || !scene.lamps.empty() || (alpha && !is_simple(scene.shape));
    if (is_traced) {
        if (scene.samples == 0 && (scene.floor || !is_opaque(scene.shape)))
            scene.samples = kRoughSamples;
        DrawnPicture drawn = trace_stack(scene, surface, traced(progress));
        expose(drawn.picture);
        return drawn;
    }
    const Painter painter(std::move(scene));
    DrawnPicture drawn;
    drawn.survey = painter.survey(execution_.threads);
    ColorPlan plan{.range = drawn.survey.range,
                   .points = drawn.survey.points,
                   .tolerance = tolerance_,
                   .exact = typed_.exact,
                   .threads = execution_.threads,
                   .simd = execution_.simd};
    const auto paint = [&](const auto& colors) {
        drawn.picture = painter.paint(colors, execution_.threads, progress);
        drawn.report = colors.report();
    };
    if (is_simple(scene_.shape))
        paint(ReflectedColors(light_->tables, light_->transform, std::move(surface), plan));
    else
        paint(
            PathColors(light_->tables, light_->transform, surface, is_opaque(scene_.shape), plan));
    expose(drawn.picture);
    return drawn;
}

nlohmann::json PictureQuery::request() const {
    nlohmann::json request{
        {"size", {scene_.camera.width, scene_.camera.height}},
        {"shape", typed_.shape},
        {"camera", typed_.camera},
        {"environment",
         environment_hash_.empty() ? typed_.environment : "sha256:" + environment_hash_},
        {"background", typed_.background},
        {"samples", scene_.alpha && typed_.samples.empty() ? kRoughSamples : scene_.samples},
        {"seed", scene_.seed},
        {"exposure", exposure_},
        {"observer", typed_.light.observer}};
    if (scene_.alpha) request["alpha"] = *scene_.alpha;
    if (!lamp_request_.empty()) request["lights"] = lamp_request_;
    if (scene_.floor) request["floor"] = *scene_.floor;
    if (typed_.paths != "single") request["paths"] = typed_.paths;
    if (typed_.transmission != "single") request["transmission"] = typed_.transmission;
    if (scene_.shape == ShapeKind::plane) request["tilt_deg"] = scene_.tilt_deg;
    request["illuminant"] = typed_.light.illuminant;
    if (typed_.exact)
        request["exact"] = true;
    else
        request["tolerance"] = tolerance_;
    if (scene_.noise)
        request["thickness_noise"] = {{"range_nm", {scene_.noise->least_nm, scene_.noise->most_nm}},
                                      {"scale", scene_.noise->scale},
                                      {"seed", scene_.noise->seed},
                                      {"octaves", scene_.noise->octaves},
                                      {"layer", noise_layer_}};
    return request;
}

std::string PictureQuery::caution(const DrawnPicture& drawn) {
    constexpr double kVisible = 1e-4;
    if (drawn.report.color_error <= kVisible) return "";
    return "colours have errors of up to " + rounded_text(drawn.report.color_error) +
           " in X, Y, Z: fringes of the stack are too fine";
}

std::vector<std::string> PictureQuery::stats(const DrawnPicture& drawn) const {
    const ColorReport& report = drawn.report;
    const ShownRange& range = drawn.survey.range;
    std::vector<std::string> lines;
    const auto degrees = [](double cosine) {
        return rounded_text(std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi);
    };
    if (drawn.is_traced)
        lines.push_back(std::to_string(drawn.survey.points) + " paths of up to " +
                        std::to_string(PathTracer::kBounces) +
                        " reflections, drawn by the surface and by lights, weighted by the balance "
                        "heuristic");
    else
        lines.push_back(std::to_string(drawn.survey.points) +
                        " places where light meets the stack, " + "angles " +
                        degrees(range.largest_cosine) + " to " + degrees(range.least_cosine) +
                        " degrees" +
                        (scene_.noise ? ", thickness " + rounded_text(range.least_nm) + " to " +
                                            rounded_text(range.largest_nm) + " nm"
                                      : ""));
    const std::string what = report.wavelengths > 0 ? "spectra" : "colours";
    if (report.wavelengths > 0)
        lines.push_back((drawn.is_traced ? "what a path meets multiplied at "
                                         : "reflectance and transmittance multiplied at ") +
                        std::to_string(report.wavelengths) + " wavelengths");
    if (report.cosines > 0)
        lines.push_back(what + " from a table of " + std::to_string(report.cosines) + " angles x " +
                        std::to_string(report.thicknesses) + " thicknesses, " +
                        std::to_string(report.evaluations) + " computed, error " +
                        rounded_text(report.error) + " CIEDE2000: " + report.reason);
    else
        lines.push_back(what + " computed one by one: " + report.reason);
    for (const std::string& text : drawn.skipped) lines.push_back("skipped: " + text);
    if (!drawn.is_traced && is_simple(scene_.shape))
        lines.emplace_back("skipped: what the stack transmits, as nothing is seen through a " +
                           typed_.shape);
    if (!scene_.noise) lines.emplace_back("skipped: the axis of thickness, which does not vary");
    return lines;
}

}  // namespace irido::cli
