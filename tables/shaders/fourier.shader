//! use: common complex sensitivity
// XYZ of the light that one film reflects, from the series of its fringes and the table
// `sensitivity` with both parts (Belcour and Barla 2017, with exact polarized Fresnel terms and
// the base's phase).
// n1, n2      indices of the incident medium and of the film
// n3          complex index of the base, (n, k)
// cos_theta   of the angle of incidence, in medium 1
// orders      of the series; where the paths leave the table the fringes are taken as gone
// level       of the spread of the path, see irido_sensitivity()
// No light is lost past the film's critical angle: there the result is the white.
float3 irido_film(TEXTURE2D(table), float3 opd_axis, float3 carrier_nm, float n1, float n2,
                  float2 n3, float thickness_nm, float cos_theta, int orders, float level)
{
    float3 white, nothing, re, im;
    irido_sensitivity(PASS2D(table), opd_axis, carrier_nm, 0.0, 0.0, white, nothing);
    float s2 = n1 * n1 * (1.0 - cos_theta * cos_theta);
    if (s2 >= n2 * n2 || cos_theta <= 0.0) return white;
    float q1 = n1 * cos_theta;
    float q2 = sqrt(n2 * n2 - s2);
    float2 eps3 = irido_mul(n3, n3);
    float2 q3 = irido_sqrt(eps3 - float2(s2, 0.0));
    float opd_nm = 2.0 * thickness_nm * q2;
    float3 xyz = float3(0.0, 0.0, 0.0);
    for (int p = 0; p < 2; ++p)
    {
        // admittances: q for s, eps / q for p
        float y1 = p == 0 ? q1 : n1 * n1 / q1;
        float y2 = p == 0 ? q2 : n2 * n2 / q2;
        float2 y3 = p == 0 ? q3 : irido_div(eps3, q3);
        float r12 = (y1 - y2) / (y1 + y2);
        float2 r23 = irido_div(float2(y2, 0.0) - y3, float2(y2, 0.0) + y3);
        float R12 = r12 * r12, R23 = dot(r23, r23);
        float T0 = (1.0 - R12) * (1.0 - R23) / (1.0 - R12 * R23);
        float2 bounce = -r12 * r23;
        float2 power = float2(1.0, 0.0);
        float3 sum = (1.0 - T0) * white;
        for (int m = 1; m <= orders; ++m)
        {
            float path = float(m) * opd_nm;
            if (path > opd_axis.y) break;
            power = irido_mul(power, bounce);
            irido_sensitivity(PASS2D(table), opd_axis, carrier_nm, path, level, re, im);
            sum -= 2.0 * T0 * (power.x * re - power.y * im);
        }
        xyz += 0.5 * sum;
    }
    return xyz;
}
