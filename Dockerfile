# Waft on a bare Debian 13: built, with its demo flown and its tests passed.
#
#     docker build -t waft .
#     docker run --rm -v "$PWD:/here" -w /here waft synthesize SCENE --output OUT
FROM debian:13-slim
RUN apt-get update -q && apt-get install -y -q --no-install-recommends ca-certificates git && rm -rf /var/lib/apt/lists/*
COPY . /waft
WORKDIR /waft
RUN ./waft demo
RUN ./waft test
ENTRYPOINT ["/waft/waft"]
