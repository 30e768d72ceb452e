"""A certificate for HTTPS in the local network, made once and kept in a file with its key.

No authority signs for an address such as 192.168.0.7, so browsers warn once. Whoever wants no warning installs the
authority of this file, which has signed one certificate, for one address: its own key is thrown away.
"""

import ipaddress
import os
import ssl
from datetime import UTC, datetime, timedelta
from pathlib import Path

from pigaming_app.storage.safe_files import write_atomic
from pigaming_app.ui.web.network import ServerUnavailable

DAYS = 800  # iOS refuses more than 825 (support.apple.com/en-us/103769)
LEFT = 30  # days before the end, from which it is made anew
NAME = "PiGaming"


class Certificate:
    """The certificate of a file for an address; made if there is none that still holds.

    Raises ServerUnavailable without the library, OSError if the file cannot be written.
    """

    def __init__(self, path: Path, address: str) -> None:
        try:
            import cryptography.x509  # noqa: F401
        except ImportError:
            raise ServerUnavailable("missing") from None
        if not _holds(path, address):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.touch()
            os.chmod(path, 0o600)  # which stays
            write_atomic(path, _made(address))
        self.context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        self.context.minimum_version = ssl.TLSVersion.TLSv1_2
        self.context.load_cert_chain(path)
        self.authority = ssl.PEM_cert_to_DER_cert(_parts(path)[-1])  # for phones that install it


def _parts(path: Path) -> list[str]:
    """The certificates of a file: that of the server, and that of its authority."""
    begin = "-----BEGIN CERTIFICATE-----"
    return [begin + part for part in path.read_text(encoding="ascii").split(begin)[1:]]


def _holds(path: Path, address: str) -> bool:
    from cryptography import x509

    try:
        ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(path)
        first = x509.load_pem_x509_certificate(_parts(path)[0].encode())
        names = first.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except (OSError, ValueError, IndexError, x509.ExtensionNotFound):  # ssl.SSLError is an OSError
        return False
    listed = names.get_values_for_type(x509.IPAddress)
    return ipaddress.ip_address(address) in listed and first.not_valid_after_utc > datetime.now(UTC) + timedelta(LEFT)


def _made(address: str) -> bytes:
    """Key, certificate and authority in PEM. Source of the extensions: RFC 5280, section 4.2.1."""
    from cryptography import x509
    from cryptography.hazmat.primitives import hashes, serialization
    from cryptography.hazmat.primitives.asymmetric import ec
    from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

    ip = ipaddress.ip_address(address)
    key, signing = ec.generate_private_key(ec.SECP256R1()), ec.generate_private_key(ec.SECP256R1())
    now = datetime.now(UTC)

    def named(name: str) -> x509.Name:
        return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, name)])

    def begun(name: str, public: ec.EllipticCurvePublicKey) -> x509.CertificateBuilder:
        builder = x509.CertificateBuilder().subject_name(named(name)).issuer_name(named(f"{NAME} {address}"))
        builder = builder.public_key(public).serial_number(x509.random_serial_number())
        return builder.not_valid_before(now - timedelta(1)).not_valid_after(now + timedelta(DAYS))

    only = x509.NameConstraints([x509.IPAddress(ipaddress.ip_network(f"{address}/32"))], None)
    never = ("content_commitment", "key_encipherment", "data_encipherment", "key_agreement")
    usage = dict.fromkeys((*never, "encipher_only", "decipher_only"), False)

    def used(signs: bool) -> x509.KeyUsage:
        return x509.KeyUsage(digital_signature=not signs, key_cert_sign=signs, crl_sign=signs, **usage)

    signer = x509.SubjectKeyIdentifier.from_public_key(signing.public_key())
    authority = (
        begun(f"{NAME} {address}", signing.public_key())
        .add_extension(x509.BasicConstraints(True, 0), critical=True)
        .add_extension(used(True), critical=True)
        .add_extension(only, critical=True)
        .add_extension(signer, critical=False)
        .sign(signing, hashes.SHA256())
    )
    server = (
        begun(address, key.public_key())
        .add_extension(x509.BasicConstraints(False, None), critical=True)
        .add_extension(used(False), critical=True)
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.SERVER_AUTH]), critical=False)
        .add_extension(x509.SubjectAlternativeName([x509.IPAddress(ip)]), critical=False)
        .add_extension(x509.AuthorityKeyIdentifier.from_issuer_subject_key_identifier(signer), critical=False)
        .sign(signing, hashes.SHA256())
    )
    plain = serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    pem = serialization.Encoding.PEM
    return key.private_bytes(pem, *plain) + server.public_bytes(pem) + authority.public_bytes(pem)
