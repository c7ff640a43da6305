# antigrasp from its Debian packages: docker build -t antigrasp . && docker run --rm -v "$PWD:/work" antigrasp evaluate part.stl
FROM debian:bookworm AS build
COPY . /src
RUN apt-get update && /src/scripts/setup && apt-get install -y --no-install-recommends pybind11-dev python3-dev python3-numpy
RUN cd /src && cmake --preset python -DANTIGRASP_TESTS=OFF && cmake --build --preset python && cd build/release && cpack

FROM debian:bookworm
COPY --from=build /src/build/release/*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/antigrasp_*.deb /tmp/python3-antigrasp_*.deb \
    && rm -rf /tmp/*.deb /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["antigrasp"]
