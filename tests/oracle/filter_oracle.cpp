#include "tests/oracle/filter_oracle.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace irido::oracle {

namespace {

// more digits than required: at grazing angles and for small alpha some are lost
using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<70>,
                                           boost::multiprecision::et_off>;

const Real kPi = boost::math::constants::pi<Real>();

struct Angles {
    Real ci, si, cd, sd, psi_max, scale;

    Angles(double alpha, double theta_i_deg, double theta_d_deg) {
        const Real i = Real(theta_i_deg) * kPi / 180, d = Real(theta_d_deg) * kPi / 180;
        ci = cos(i), si = sin(i), cd = cos(d), sd = sin(d);
        const Real limit = -(ci * cd) / (si * sd);
        psi_max = limit > -1 ? Real(acos(limit)) : kPi;
        const Real a = alpha, G1 = 2 / (1 + sqrt(1 + a * a * si * si / (ci * ci)));
        scale = 2 * G1 * G1 * cd / ci * sd * a * a / kPi;
    }
};

}  // namespace

double transmission_filter(double alpha, double theta_i_deg, double theta_d_deg) {
    const Angles at(alpha, theta_i_deg, theta_d_deg);
    const Real a2 = Real(alpha) * alpha;
    const auto integrand = [&](const Real& psi) {
        const Real x = at.ci * at.cd + at.si * at.sd * cos(psi), root = 1 - (1 - a2) * x * x;
        return Real(1 / (root * root));
    };
    static boost::math::quadrature::tanh_sinh<Real> rule(9);
    Real sum = 0, begin = 0;
    for (Real end = Real(alpha) / 4; begin < at.psi_max; end *= 2) {
        if (end > at.psi_max) end = at.psi_max;
        const Real half = (end - begin) / 2, middle = (begin + end) / 2;
        const auto on_unit = [&](const Real& t) { return integrand(middle + half * t); };
        sum += half * rule.integrate(on_unit, Real(1e-22));
        begin = end;
    }
    return static_cast<double>(at.scale * sum);
}

}  // namespace irido::oracle
