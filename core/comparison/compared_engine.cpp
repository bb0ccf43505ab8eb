#include "core/comparison/compared_engine.hpp"

#include <algorithm>

#include "core/colorimetry/difference.hpp"
#include "core/engines/series.hpp"

namespace irido {

namespace {

ColorMatrix product_of(const ColorMatrix& a, const ColorMatrix& b) {
    ColorMatrix result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < 3; ++k) result[i][j] += a[i][k] * b[k][j];
    return result;
}

ColorMatrix inverse_of(const ColorMatrix& m) {
    ColorMatrix result{};
    double determinant = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            result[j][i] = m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
        }
        determinant += m[0][i] * (m[1][i1] * m[2][i2] - m[1][i2] * m[2][i1]);
    }
    for (Triple& row : result)
        for (double& entry : row) entry /= determinant;
    return result;
}

}  // namespace

bool ComparedEngine::is_cie_rgb() const {
    return engine && engine->white == "E";
}

EngineDifference::EngineDifference(const DifferenceRequest& request, const Triple& white)
    : white_(white) {
    const auto reading = [&](const ColorMatrix& xyz_from_rgb, const Triple& own) {
        if (request.white == DifferenceRequest::White::own) return Reading{xyz_from_rgb, own};
        return Reading{product_of(bradford(own, white), xyz_from_rgb), white};
    };
    srgb_ = reading(xyz_from_rgb(rgb_space("srgb")), rgb_space("srgb").white);
    cie_rgb_ = request.as_cie_rgb ? reading(inverse_of(kMaterialXRgb), {1, 1, 1}) : srgb_;
}

Triple EngineDifference::lab_of_engine(const ComparedEngine& engine, const Triple& rgb) const {
    const Reading& reading = engine.is_cie_rgb() ? cie_rgb_ : srgb_;
    return lab(product(reading.xyz_from_rgb, rgb), reading.white);
}

Triple EngineDifference::lab_of_exact(const Triple& xyz) const {
    return lab(xyz, white_);
}

double EngineDifference::operator()(const ComparedEngine& engine, const Triple& rgb,
                                    const Triple& xyz) const {
    return ciede2000(lab_of_engine(engine, rgb), lab_of_exact(xyz));
}

}  // namespace irido
