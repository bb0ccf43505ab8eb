#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/color_options.hpp"
#include "cli/queries/traced_picture.hpp"

namespace irido::cli {

/// Options of a rendered picture, as given on the command line.
struct PictureQueryOptions {
    std::string size;  ///< "" for the default
    std::string shape = "sphere";
    std::string tilt = "0";
    std::string environment = "studio";
    std::string camera = "orthographic";
    std::string background = "none";
    std::string thickness_noise;  ///< "" for none
    std::string octaves = "1";
    std::string noise_layer = "1";
    std::vector<std::string> lamps;  ///< each a lamp or several, JSON or a file
    std::string floor;               ///< "" for none
    std::string paths = "single", transmission = "single";
    std::string alpha;    ///< "" for a smooth surface
    std::string samples;  ///< "" for the default
    std::string seed = "1";
    std::string exposure = "0";
    std::string tolerance = "0.1";
    bool exact = false;
    ColorOptions light;  ///< illuminant and observer

    void add(CLI::App& command);
};

/// Pictures of a stack or a surface on a shape.
class PictureQuery {
public:
    /// usual_size: the default size. Throws UsageError, or InputError for errors in a file.
    PictureQuery(const PictureQueryOptions& typed, const Execution& execution,
                 std::size_t usual_size = 512);

    /// `progress` receives an increasing fraction, from any thread; `alpha`, if present, replaces
    /// the given roughness. Throws InputError for a stack that cannot be drawn.
    DrawnPicture draw(const schemas::StackDocument& document,
                      const std::function<void(double)>& progress,
                      std::optional<double> alpha = {}) const;
    /// Of a surface document, which has a roughness of its own.
    DrawnPicture draw(const schemas::SurfaceDocument& document,
                      const std::function<void(double)>& progress) const;

    const PictureScene& scene() const { return scene_; }
    const Sensitivity& sensitivity() const { return light_->tables.sensitivity(); }
    /// Everything but the stack that determines the pixels, without paths.
    nlohmann::json request() const;
    /// Lines of statistics about a picture.
    std::vector<std::string> stats(const DrawnPicture& drawn) const;
    /// A warning about the picture; "" if there is none.
    static std::string caution(const DrawnPicture& drawn);

private:
    void set_lights(const PictureQueryOptions& typed);
    void require_seen_lamps(const std::string& shape) const;
    DrawnPicture draw_stack(const Stack& stack, const std::function<void(double)>& progress,
                            std::optional<double> alpha) const;
    TracedRequest traced(const std::function<void(double)>& progress) const;
    void expose(Picture& picture) const;

    PictureQueryOptions typed_;
    Execution execution_;
    PictureScene scene_;
    std::string environment_hash_;  ///< of an environment from a file
    std::size_t noise_layer_;
    double exposure_, tolerance_;
    std::unique_ptr<Illumination> light_;
    std::vector<std::unique_ptr<Sensitivity>> lamp_lights_;  ///< of lamps' own illuminants
    nlohmann::json lamp_request_;                            ///< lamps as they were read
    Paths paths_;
    Crossings crossings_;
};

}  // namespace irido::cli
