// F_alpha per radian in closed form, without a table (filter of Fourneau, Pacanowski and Barla
// 2024, eq. 29). alpha in (0, 1], angles in radians in [0, pi/2).
float irido_smith_g1(float alpha, float theta)
{
    float t = alpha * tan(theta);
    return 2.0 / (1.0 + sqrt(1.0 + t * t));
}

// Integral of 1 / (p + q cos psi) + 1 / (p + q cos psi)^2 over psi from 0 to an end, given by the
// sine and cosine of the end and of its half; P = p + q, M = p - q.
float irido_falpha_part(float P, float M, float2 end, float2 half_end)
{
    float p = 0.5 * (P + M), q = 0.5 * (P - M);
    float J1 = 2.0 / sqrt(P * M) * atan2(sqrt(M) * half_end.x, sqrt(P) * half_end.y);
    float J2 = (p * J1 - q * end.x / (p + q * end.y)) / (P * M);
    return J1 + J2;
}

float irido_falpha_closed(float alpha, float theta_i, float theta_d)
{
    float s = sqrt(max(1.0 - alpha * alpha, 0.0));
    float rest = alpha * alpha / (1.0 + s);  // 1 - s
    float low = sin(0.5 * (theta_i - theta_d)), high = sin(0.5 * (theta_i + theta_d));
    // end of psi as (sin, cos), and of its half
    float2 end = float2(0.0, -1.0), half_end = float2(1.0, 0.0);
    if (theta_i + theta_d > 1.57079632679)
    {
        float c = clamp(-1.0 / (tan(theta_i) * tan(theta_d)), -1.0, 1.0);
        end = float2(sqrt(max(1.0 - c * c, 0.0)), c);
        half_end = float2(sqrt(0.5 * (1.0 - c)), sqrt(0.5 * (1.0 + c)));
    }
    // 1 - s x and 1 + s x at psi = 0 and pi, x = cos(theta_m)
    float below0 = rest + 2.0 * s * low * low, below1 = rest + 2.0 * s * high * high;
    float above0 = 2.0 - below0, above1 = 2.0 - below1;
    float sum = irido_falpha_part(below0, below1, end, half_end) +
                irido_falpha_part(above0, above1, end, half_end);
    float g = irido_smith_g1(alpha, theta_i);
    float D = alpha * alpha / 3.14159265359 * 0.25 * sum;
    return 2.0 * g * g * cos(theta_d) / cos(theta_i) * sin(theta_d) * D;
}
