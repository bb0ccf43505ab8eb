#include "core/truth/filter_reference.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "core/error.hpp"
#include "core/rough/ggx.hpp"

namespace irido {

namespace {

// more digits than promised: grazing angles and small alpha lose some
using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>,
                                           boost::multiprecision::et_off>;

}  // namespace

double reference_filter(double alpha, double theta_i_deg, double theta_d_deg) {
    require_in_range("alpha", alpha, kSmoothest, kRoughest);
    require_in_range("theta_i_deg", theta_i_deg, 0, 90);
    require_in_range("theta_d_deg", theta_d_deg, 0, 90);
    if (theta_i_deg == 90 || theta_d_deg == 90 || theta_d_deg == 0) return 0;
    const Real pi = boost::math::constants::pi<Real>(), a = alpha, s = sqrt(1 - a * a);
    const Real ti = Real(theta_i_deg) * pi / 180, td = Real(theta_d_deg) * pi / 180;
    const Real cc = cos(ti) * cos(td), ss = sin(ti) * sin(td), tan_i = tan(ti);
    const Real cos_max = theta_i_deg == 0 ? Real(-2) : Real(-cc / ss);
    const Real psi = cos_max > -1 ? Real(acos(cos_max)) : pi;
    Real sum = 0;
    for (const int sign : {1, -1}) {
        const Real p = 1 - sign * s * cc, q = -sign * s * ss, P = p + q, M = p - q;
        const Real J1 = 2 / sqrt(P * M) * atan2(sqrt(M) * sin(psi / 2), sqrt(P) * cos(psi / 2));
        sum += J1 + (p * J1 - q * sin(psi) / (p + q * cos(psi))) / (P * M);
    }
    const Real G1 = 2 / (1 + sqrt(1 + a * a * tan_i * tan_i));
    return static_cast<double>(2 * G1 * G1 * cos(td) / cos(ti) * sin(td) * a * a / pi * sum / 4);
}

}  // namespace irido
