// Power reflectance of N periods of two lossless layers in a host of the index of the first, for
// unpolarized light (Yeh 1988, section 6.3; band edges without cancellation, gaps without
// overflow).
float irido_bragg_polarized(float q, float a, float b, float periods)
{
    float h = 0.5 * (a + b), g = 0.5 * (a - b);
    float sh = sin(h), ch = cos(h), sg = sin(g), cg = cos(g);
    // (1 -+ cos KL) / 2
    float FF = 0.25 * ((1.0 + q) * sh + (1.0 - q) * sg) * ((1.0 + 1.0 / q) * sh + (1.0 - 1.0 / q) * sg);
    float GG = 0.25 * ((1.0 + q) * ch + (1.0 - q) * cg) * ((1.0 + 1.0 / q) * ch + (1.0 - 1.0 / q) * cg);
    float C = 0.5 * (q - 1.0 / q) * sin(b);
    float inverse_U;  // 1 / U
    if (FF < 0.0 || GG < 0.0)
    {
        float x = sqrt(max(-min(FF, GG), 0.0));
        float kappa = 2.0 * log(x + sqrt(x * x + 1.0));
        // sinh(kappa) / sinh(N kappa)
        float fall = exp(-2.0 * periods * kappa);
        inverse_U = 1.0 / periods;
        if (kappa > 1e-6)
        {
            inverse_U = exp(-(periods - 1.0) * kappa) * (1.0 - exp(-2.0 * kappa)) / (1.0 - fall);
        }
    }
    else
    {
        float KL = 2.0 * atan2(sqrt(FF), sqrt(GG));
        float s = 2.0 * sqrt(FF * GG), S = sin(periods * KL);
        // at a closed gap U = N
        inverse_U = 1.0 / periods;
        if (s * periods >= 1e-4)
        {
            if (abs(S) < 1e-12) { return 0.0; }
            inverse_U = s / S;
        }
    }
    return C * C / (C * C + inverse_U * inverse_U);
}

// n1, d1_nm  index and thickness of the first layer, n2, d2_nm of the second
// cos_theta  of the angle of incidence, in the host of index n1
float irido_bragg(float n1, float d1_nm, float n2, float d2_nm, float periods, float cos_theta,
                  float wavelength_nm)
{
    float k0 = 6.28318530718 / wavelength_nm;
    float s2 = n1 * n1 * (1.0 - cos_theta * cos_theta);
    if (s2 >= n2 * n2 || cos_theta <= 0.0) { return 1.0; }  // tunnelling left out
    float q1 = n1 * cos_theta, q2 = sqrt(n2 * n2 - s2);
    float a = k0 * d1_nm * q1, b = k0 * d2_nm * q2;
    float s = irido_bragg_polarized(q2 / q1, a, b, periods);
    float p = irido_bragg_polarized(n1 * n1 * q2 / (n2 * n2 * q1), a, b, periods);
    return 0.5 * (s + p);
}
